// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/math/morton.h"

#include <gtest/gtest.h>

namespace vegetation_sim {
namespace {

// Any aligned square of 4 m by 4 m is one stretch of the curve.
TEST(Morton, SquaresAreStretchesOfTheCurve) {
  for (const double corner : {-1024.0, 0.0, 4096.0})
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) {
        const std::uint64_t key = mortonKey(corner + x + 0.5, corner + y + 0.5);
        EXPECT_EQ(key / 16, mortonKey(corner, corner) / 16);
        EXPECT_EQ(key % 16,
                  static_cast<std::uint64_t>((x & 1) | (y & 1) << 1 | (x & 2) << 1 | (y & 2) << 2));
      }
}

TEST(Morton, PlacesBeyondAllLandscapesHaveTheLastKeys) {
  EXPECT_EQ(mortonKey(-1e9, -1e9), 0u);
  EXPECT_EQ(mortonKey(1e9, 1e9), (std::uint64_t{1} << 52) - 1);
}

}  // namespace
}  // namespace vegetation_sim
