// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/math/growth_stage.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegetation_sim {
namespace {

TEST(GrowthStage, IsASeedlingAtZeroAndLeavesTheGrownPlantAsItIs) {
  const GrowthFactors seedling = growthFactors(SEEDLING), grown = growthFactors(GROWN);
  EXPECT_DOUBLE_EQ(seedling.height, 0.05);
  EXPECT_DOUBLE_EQ(seedling.thickness, std::pow(0.05, 1.5));
  EXPECT_DOUBLE_EQ(seedling.count, 0.2);
  for (const double factor : {grown.height, grown.thickness, grown.count, grown.leaf})
    EXPECT_EQ(factor, 1.0);
}

TEST(GrowthStage, RaisesEveryFactor) {
  for (int i = 0; i < 100; ++i) {
    const GrowthFactors before = growthFactors(0.01 * i), after = growthFactors(0.01 * (i + 1));
    EXPECT_LT(before.height, after.height);
    EXPECT_LT(before.thickness, after.thickness);
    EXPECT_LT(before.count, after.count);
    EXPECT_LT(before.leaf, after.leaf);
  }
}

}  // namespace
}  // namespace vegetation_sim
