// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/tree/growth/forest_layout.h"

namespace vegetation_sim::fuzz {

/// A small forest for inputs that need one.
inline forest::Layout twoBushes() {
  forest::Layout out;
  out.species.resize(1);
  out.species[0].name = "bush";
  out.species[0].height = 1.5;
  out.species[0].limbs.resize(1);
  out.trees.resize(2);
  out.trees[1].position = Vec3(2.0, 0.0, 0.0);
  return out;
}

}  // namespace vegetation_sim::fuzz
