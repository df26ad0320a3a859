// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/map/grass_species.h"

#include <algorithm>

#include "core/math/growth_stage.h"

namespace vegetation_sim::grass {
namespace {

constexpr double FLOWER_STAGE = 0.6;
constexpr double LOWEST = 0.05;     // factor on the height of the map
constexpr double NARROWEST = 1e-4;  // [m]

}  // namespace

void describe(FieldVisitor& v, Species& s) {
  v.number("height", s.height, "", {0.05, 5.0});
  v.number("height_spread", s.height_spread, "", {0.0, 0.9});
  v.number("width", s.width, "m", {1e-4, 0.2});
  v.number("lean", s.lean, "rad", {0.0, 1.4});
  v.number("compliance", s.compliance, "rad s/m", {0.0, 10.0});
  v.vector("colour", s.colour, "", {0.0, 1.0});
  v.vector("dry_colour", s.dry_colour, "", {0.0, 1.0});
  v.number("flower_radius", s.flower_radius, "m", {0.0, 0.2});
  v.vector("flower_colour", s.flower_colour, "", {0.0, 1.0});
}

Species applyStage(const Species& species, double stage) {
  if (!(stage < GROWN)) return species;
  const GrowthFactors factors = growthFactors(stage);
  Species out = species;
  out.height = std::max(LOWEST, factors.height * species.height);
  out.width = std::max(NARROWEST, factors.leaf * species.width);
  if (stage < FLOWER_STAGE) out.flower_radius = 0.0;
  return out;
}

}  // namespace vegetation_sim::grass
