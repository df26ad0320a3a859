// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/map/grass_species.h"

namespace vegetation_sim::grass {

void describe(FieldVisitor& v, Species& s) {
  v.number("height", s.height, "", {0.05, 5.0});
  v.number("height_spread", s.height_spread, "", {0.0, 0.9});
  v.number("width", s.width, "m", {1e-4, 0.2});
  v.number("lean", s.lean, "rad", {0.0, 1.4});
  v.number("compliance", s.compliance, "rad s/m", {0.0, 1.0});
  v.vector("colour", s.colour, "", {0.0, 1.0});
  v.vector("dry_colour", s.dry_colour, "", {0.0, 1.0});
  v.number("flower_radius", s.flower_radius, "m", {0.0, 0.2});
  v.vector("flower_colour", s.flower_colour, "", {0.0, 1.0});
}

}  // namespace vegetation_sim::grass
