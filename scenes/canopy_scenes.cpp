// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Plants of many leaves.
#include "scenes/catalogue.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scenes {
namespace {

void lookAtPlants(World& world) {
  world.setCamera(Vec3(-6.0, 0.0, 1.6), 0.0);
}

void turnRound(World& world) {
  const int tick = world.tick();
  const double t = world.nextSeconds();
  if (tick < 200) world.setCamera(Vec3(-6.0 + 0.2 * t, 0.0, 1.6), 0.02 * t);
  if (tick == 200) world.setCamera(Vec3(-3.0, -4.0, 1.8), 0.8);
  if (tick == 300) world.changeWind();
}

forest::Body robotAt(double turns, const Vec3& velocity, Nanoseconds stamp) {
  const SinCos way = sinCosTurns(turns);
  forest::Body out;
  out.id = "robot";
  out.shape = forest::Shape::BOX;
  out.size = Vec3(0.7, 0.5, 0.6);
  out.pose.position = Vec3(2.0 * way.cos, 1.8 * way.sin - 0.5, 0.45);
  out.pose.orientation = {way.cos, 0.0, 0.0, way.sin};
  out.velocity = velocity;
  out.spin = Vec3(0.0, 0.0, 0.5);
  out.stamp = stamp;
  return out;
}

// A robot drives in an ellipse until tick 400; a ball hangs in the crown from tick 200 on.
void pushPlants(World& world) {
  canopy::Canopy& plants = world.canopy->canopy();
  const int tick = world.tick();
  const double turns = tick / 300.0;
  if (tick < 400) {
    const SinCos way = sinCosTurns(turns);
    const Vec3 velocity(-1.2566 * way.sin, 1.131 * way.cos, 0.0);
    plants.setBody(robotAt(turns, velocity, world.next()));
  }
  if (tick == 400) plants.removeBody("robot");
  if (tick != 200) return;
  forest::Body ball;
  ball.id = "ball";
  ball.size.x() = 0.3;
  ball.pose.position = Vec3(1.6, 0.7, 1.5);
  ball.stamp = world.next();
  plants.setBody(ball);
}

double meanDisplacement(World& world) {
  return world.canopy->meanDisplacement();
}

}  // namespace

std::vector<SceneEntry> canopyScenes() {
  return {{"leafy_shrubs", "shrubs, a crown and reeds in moving air, layers cut anew",
           "mean displacement of leaves [m]", lookAtPlants, turnRound, meanDisplacement},
          {"printed_leaves", "kelp and a shrub by the printed solver, layers and warp",
           "mean displacement of leaves [m]", lookAtPlants, turnRound, meanDisplacement},
          {"pushed_plants", "a robot drives through shrubs and reeds, a ball hangs in a crown",
           "mean displacement of leaves [m]", lookAtPlants, pushPlants, meanDisplacement}};
}

}  // namespace vegetation_sim::scenes
