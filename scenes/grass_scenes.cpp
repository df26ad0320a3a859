// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Grass that is trodden and looked at.
#include "scenes/catalogue.h"

namespace vegetation_sim::scenes {
namespace {

/// A wheel in circles, a walker in steps, strokes, and an area that is raised again.
void roll(World& world) {
  const int tick = world.tick();
  const Nanoseconds stamp = world.next();
  const SinCos at = sinCosTurns(world.nextSeconds() / 8.0);
  world.grass->tread("wheel", 3.0 * at.cos, 3.0 * at.sin, stamp);
  if (tick % 30 < 15)
    world.grass->tread("foot", -4.0 + 0.01 * (tick - tick % 30), 1.0, stamp);
  else if (tick % 30 == 15)
    world.grass->lift("foot", stamp);
  if (tick == 150)
    world.grass->stroke("scythe", Vec3(-5.0, -3.0, 0.0), Vec3(-1.0, -3.5, 0.0), stamp);
  if (tick == 400) world.grass->raise(0.0, 3.0, 1.0);
  if (tick == 300) world.changeWind();
}

void lookOver(World& world) {
  world.setCamera(Vec3(-6.0, 0.0, 1.6), 0.0);
}

/// The camera walks over the meadow and turns, and a stone rolls in front of it.
void walkOver(World& world) {
  const double t = world.nextSeconds();
  world.setCamera(Vec3(-8.0 + 1.2 * t, 0.5 * t, 1.7), 0.25 * t);
  world.grass->tread("stone", -4.0 + 1.2 * t, 0.4 * t, world.next());
  if (world.tick() == 300) world.changeWind();
}

double crushedArea(World& world) {
  return world.grass->crushedArea();
}

}  // namespace

std::vector<SceneEntry> grassScenes() {
  return {{"trodden_grass", "sources that roll, step and stroke, raising and recovery",
           "crushed area [m^2]", lookOver, roll, crushedArea},
          {"viewed_meadow", "levels of detail of a meadow of four species on hills",
           "crushed area [m^2]", lookOver, walkOver, crushedArea}};
}

}  // namespace vegetation_sim::scenes
