// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Plants of many leaves.
#include "scenes/catalogue.h"

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

double meanDisplacement(World& world) {
  return world.canopy->meanDisplacement();
}

}  // namespace

std::vector<SceneEntry> canopyScenes() {
  return {{"leafy_shrubs", "shrubs, a crown and reeds in moving air, layers cut anew",
           "mean displacement of leaves [m]", lookAtPlants, turnRound, meanDisplacement},
          {"printed_leaves", "kelp and a shrub by the printed solver, layers and warp",
           "mean displacement of leaves [m]", lookAtPlants, turnRound, meanDisplacement}};
}

}  // namespace vegetation_sim::scenes
