// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/canopy/canopy_cover.h"

#include <gtest/gtest.h>

namespace vegetation_sim {
namespace {

canopy::Layout plantsAt(double x, double y) {
  canopy::Layout out;
  out.kinds.resize(1);
  out.plants.resize(2);
  out.plants[1].position = Vec3(x, y, 0.0);
  return out;
}

TEST(CanopyCover, HasTheResolutionAskedFor) {
  const auto map = CanopyCover(plantsAt(10.2, 4.9), 0.5).cutShare({});
  EXPECT_EQ(map.info.resolution, 0.5f);
  EXPECT_EQ(map.info.width, 21u);
  EXPECT_EQ(map.info.height, 10u);
  EXPECT_EQ(map.data.front(), 0);
  EXPECT_EQ(map.data.back(), 0);
  EXPECT_EQ(map.data[1], -1);
}

TEST(CanopyCover, IsCoarserWherePlantsAreFarApart) {
  const auto map = CanopyCover(plantsAt(1500.0, -1500.0), 0.5).cutShare({});
  EXPECT_EQ(map.info.resolution, 1.0f);
  EXPECT_EQ(map.data.size(), 1501u * 1501u);
  EXPECT_EQ(map.info.origin.position.y, -1500.0);
  EXPECT_LE(CanopyCover(plantsAt(1e6, 1e6), 0.02).cutShare({}).data.size(), 4000000u);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
