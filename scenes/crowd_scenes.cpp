// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// People, and a landscape with everything at once.
#include "scenes/catalogue.h"

namespace vegetation_sim::scenes {
namespace {

crowd::Spawn spawnAt(double x, double y) {
  crowd::Spawn out;
  out.position = {x, y};
  return out;
}

void moveRobot(World& world) {
  crowd::Robot robot;
  robot.id = "robot";
  robot.radius = 0.4;
  robot.position = {-6.0 + 0.6 * world.nextSeconds(), 1.0};
  robot.velocity = {0.6, 0.0};
  world.crowd->crowd().setRobot(robot);
}

void nobody(World& /*world*/) {}

void mingle(World& world) {
  crowd::Crowd& crowd = world.crowd->crowd();
  const int tick = world.tick();
  if (tick < 450) moveRobot(world);
  if (tick == 450) crowd.removeRobot("robot");
  if (tick == 100) crowd.setGoal(0, {6.0, -6.0});
  if (tick == 200) crowd.remove(1);
  if (tick == 250) crowd.spawn(spawnAt(-7.5, -7.5));
  if (tick == 400) crowd.setWandering(0);
}

double meanDistance(World& world) {
  return world.crowd->meanDistance();
}

void beginLandscape(World& world) {
  world.setCamera(Vec3(-9.0, 0.0, 2.0), 0.0);
}

/// Every walker treads the grass; a robot drives under a tree of which a branch is grabbed.
void cross(World& world) {
  const int tick = world.tick();
  moveRobot(world);
  for (const crowd::Walker& walker : world.crowd->crowd().walkers())
    world.grass->tread("walker_" + std::to_string(walker.id), walker.position.x, walker.position.y,
                       world.next());
  world.setCamera(Vec3(-9.0 + 0.3 * world.nextSeconds(), 0.0, 2.0), 0.03 * world.nextSeconds());
  ForestPart& trees = *world.forest;
  if (tick == 60) {
    forest::Grab grab;
    grab.point = trees.tipPoint(0, trees.lastBranch(0, 1));
    grab.target = trees.place(grab.point) + Vec3(0.2, 0.1, -0.1);
    trees.forest().addGrab(grab);
  }
  if (tick == 360) trees.forest().release(1);
  if (tick == 200) world.crowd->crowd().spawn(spawnAt(-3.0, -3.0));
  if (tick == 300) world.changeWind();
}

}  // namespace

std::vector<SceneEntry> crowdScenes() {
  return {{"mingling_crowd", "walkers among walls with a robot, goals, a spawn and a removal",
           "mean distance of walkers from the origin [m]", nobody, mingle, meanDistance},
          {"whole_landscape", "trees, grass, leaves and people together, seen by a lidar",
           "mean distance of walkers from the origin [m]", beginLandscape, cross, meanDistance}};
}

}  // namespace vegetation_sim::scenes
