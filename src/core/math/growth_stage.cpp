// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/math/growth_stage.h"

#include <cmath>

namespace vegetation_sim {
namespace {

constexpr double SEEDLING_HEIGHT = 0.05, SEEDLING_COUNT = 0.2;

}  // namespace

GrowthFactors growthFactors(double stage) {
  GrowthFactors out;
  out.height = SEEDLING_HEIGHT + (1.0 - SEEDLING_HEIGHT) * stage;
  out.leaf = std::sqrt(out.height);
  out.thickness = out.height * out.leaf;
  out.count = SEEDLING_COUNT + (1.0 - SEEDLING_COUNT) * stage;
  return out;
}

}  // namespace vegetation_sim
