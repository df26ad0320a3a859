// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/canopy/leaf_truth.h"

#include <gtest/gtest.h>

namespace vegetation_sim::canopy {
namespace {

double errorOf(int layers, double variety) {
  static const AirRecord air(lonelyShrub(1, 1), 360);
  return compareWithTruth(300, layers, variety, 120, 300, air, [] { return 0.0; }).error;
}

// S3-06: against leaves that each move on their own more layers are better, and beyond five there
// is little left to win.
TEST(Layers, ComeCloseToLeavesOnTheirOwnWithThreeToFive) {
  const double one = errorOf(1, 0.15), three = errorOf(3, 0.15), five = errorOf(5, 0.15),
               nine = errorOf(9, 0.15);
  EXPECT_LT(three, 0.8 * one);
  EXPECT_LT(five, three);
  EXPECT_LT(five - nine, 0.25 * (one - five));
  // What is left are frequencies of their own, and neighbours in depth: no plane knows them.
  EXPECT_LT(errorOf(9, 0.0), nine);
}

}  // namespace
}  // namespace vegetation_sim::canopy
