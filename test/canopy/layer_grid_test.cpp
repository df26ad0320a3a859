// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/layer_grid.h"

#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "scenes/canopy/shrub_bank.h"

namespace vegetation_sim::canopy {
namespace {

// S3-27: without motion the warp is the identity.
TEST(LayerGrid, ShowsLeavesAtRestWhereTheyAre) {
  ShrubBank bank(3);
  bank.blow(Vec3::Zero(), 1);
  bank.makeGrids();
  const std::vector<double> errors = bank.errors(ShrubBank::eye());
  EXPECT_LT(errors.back(), 1e-6);
}

// The pictures of layers, warped, against each leaf on its own, in a wind that moves tips by six
// pixels in the mean.
TEST(LayerGrid, ShowsMovedLeavesWithinAPixel) {
  const std::map<int, double> most{{1, 2.0}, {3, 0.75}, {5, 0.6}, {9, 0.55}};  // rms [pixel]
  for (const auto& [layers, limit] : most) {
    ShrubBank bank(layers);
    bank.blow(Vec3(0.0, 8.0, 0.0), 200);
    bank.makeGrids();
    double motion = 0.0;
    bank.eachLeaf([&](const Leaf& leaf, std::size_t plant) {
      const Vec3 moved = bank.canopy().foliage().move(leaf, plant).tip;
      motion += PIXELS / 12.0 * length(Vec3(moved - leaf.tip));
    });
    EXPECT_GT(motion / static_cast<double>(bank.leafCount()), 5.0);
    EXPECT_LT(bank.rms(ShrubBank::eye()), limit) << layers << " layers";
    const std::vector<double> errors = bank.errors(ShrubBank::eye());
    EXPECT_LT(errors[errors.size() * 99 / 100], 3.0 * limit) << layers << " layers";
  }
}

// Nodes have the depth of their leaves, so that the picture remains valid beside its own eye.
TEST(LayerGrid, PredictsTheErrorOfMotionAndOfAnotherEye) {
  for (const int layers : {1, 3, 9}) {
    ShrubBank bank(layers);
    bank.blow(Vec3(0.0, 8.0, 0.0), 200);
    bank.makeGrids();
    for (const double shift : {0.0, 0.2, 1.0}) {
      const Vec3 eye = ShrubBank::eye() + Vec3(0.0, shift, 0.0);
      const double measured = bank.rms(eye), predicted = bank.predicted(eye);
      EXPECT_GT(predicted, 0.5 * measured) << layers << " layers, " << shift << " m";
      EXPECT_LT(predicted, 3.0 * measured) << layers << " layers, " << shift << " m";
    }
  }
}

TEST(LayerGrid, ShowsNothingWithoutLeaves) {
  LayerGrid grid(ImageFrame(), 8, 8);
  grid.add({Vec3(5.0, 0.0, 0.0), Vec3(5.0, 0.0, 0.0), {}});  // behind the eye
  grid.finish();
  EXPECT_TRUE(grid.cells().empty());
  EXPECT_EQ(grid.predictedError(Vec3::Zero()), 0.0);
}

}  // namespace
}  // namespace vegetation_sim::canopy
