// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Trees that only wind moves.
#include "scenes/catalogue.h"

namespace vegetation_sim::scenes {
namespace {

void standAside(World& world) {
  world.setCamera(Vec3(-15.0, 10.0, 3.0), 0.0);
}

/// The camera and a sensor circle the trees, so that their levels of detail change.
void walkRound(World& world) {
  const SinCos at = sinCosTurns(world.nextSeconds() / 10.0);
  const double radius = 14.0 + 60.0 * world.nextSeconds() / 10.0;
  world.setCamera(Vec3(10.0 - radius * at.cos, 10.0 - radius * at.sin, 3.0),
                  2.0 * PI * world.nextSeconds() / 10.0);
  world.setSensor(Vec3(10.0 + radius * at.cos, 10.0 + radius * at.sin, 1.0), 40.0, 0.02);
  if (world.tick() == 300) world.changeWind();
}

/// The camera and a sensor stay near, so that trees get modes; then they move far away.
void stayNear(World& world) {
  const double away = world.tick() < 450 ? 12.0 : 150.0;
  world.setCamera(Vec3(-away, 4.0, 3.0), 0.0);
  world.setSensor(Vec3(-away, -4.0, 1.0), 40.0, 0.005);
  if (world.tick() == 240) world.changeWind();
}

void changeWindOnce(World& world) {
  if (world.tick() == 300) world.changeWind();
}

double heightOfFirst(World& world) {
  return world.forest->height(0);
}

}  // namespace

std::vector<SceneEntry> forestScenes() {
  return {{"windy_forest", "procedural trees on hills in all kinds of wind, levels of detail",
           "height of tree 0 [m]", standAside, walkRound, heightOfFirst},
          {"modal_trees", "trees in modes, plain and fine, and their return to procedural motion",
           "height of tree 0 [m]", standAside, stayNear, heightOfFirst},
          {"paper_trees", "joint model, gain and drag as printed, quadratic drag",
           "height of tree 0 [m]", standAside, changeWindOnce, heightOfFirst}};
}

}  // namespace vegetation_sim::scenes
