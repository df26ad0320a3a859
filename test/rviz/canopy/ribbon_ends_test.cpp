// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/canopy/ribbon_ends.h"

#include <gtest/gtest.h>

namespace vegetation_sim::view {
namespace {

constexpr int RIBBONS = 8, PIECES = 5;

std::vector<canopy::Leaf> growKelp() {
  canopy::PlantKind kind;
  kind.shape = canopy::PlantShape::KELP;
  kind.leaves = RIBBONS;
  kind.pieces = PIECES;
  return canopy::grow(kind, canopy::Plant(), canopy::UNCUT).leaves;
}

// Each ribbon reaches a little below its foot and ends in a point; its pieces still join.
TEST(RibbonEnds, StandInTheGroundAndEndInAPoint) {
  const std::vector<canopy::Leaf> before = growKelp();
  std::vector<canopy::Leaf> after = before;
  finishRibbons(true, after);
  ASSERT_EQ(after.size(), static_cast<std::size_t>(RIBBONS * PIECES));
  for (std::size_t i = 0; i < after.size(); ++i) {
    const bool first = i % PIECES == 0, last = i % PIECES == PIECES - 1;
    EXPECT_EQ(isFoot(after[i]), first);
    EXPECT_EQ(after[i].tip, before[i].tip);
    if (first) {
      EXPECT_LT(after[i].root.z(), -0.02);
      EXPECT_GT(after[i].root.z(), -0.1);
    } else {
      EXPECT_EQ(after[i].root, after[i - 1].tip);
      EXPECT_EQ(after[i].root_width, after[i - 1].tip_width);
    }
    EXPECT_EQ(after[i].tip_width < 0.1F * before[i].tip_width, last);
  }
}

// What was cut keeps its blunt end, and what lies stays where it is.
TEST(RibbonEnds, CutRibbonsStayBlunt) {
  const std::vector<canopy::Leaf> before = growKelp();
  std::vector<canopy::Leaf> after = before;
  for (canopy::Leaf& leaf : after) leaf.lies = true;
  finishRibbons(false, after);
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_EQ(after[i].tip_width, before[i].tip_width);
    EXPECT_EQ(after[i].root, before[i].root);
  }
}

}  // namespace
}  // namespace vegetation_sim::view
