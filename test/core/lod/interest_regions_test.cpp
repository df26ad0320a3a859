// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/lod/interest_regions.h"

#include <gtest/gtest.h>

namespace vegetation_sim {
namespace {

constexpr double MARGIN = InterestRegions::MARGIN;

TEST(InterestRegionsTest, WithoutListenersTheWholeIsIncluded) {
  InterestRegions regions;
  EXPECT_FALSE(regions.update({}));
  EXPECT_TRUE(regions.includes(1e6, -1e6));
}

TEST(InterestRegionsTest, WhatTouchesADiscAndItsMarginIsIncluded) {
  InterestRegions regions;
  EXPECT_TRUE(regions.update({{10.0, 0.0, 30.0}}));
  EXPECT_TRUE(regions.includes(10.0 + 30.0 + MARGIN, 0.0));
  EXPECT_FALSE(regions.includes(10.0 + 30.1 + MARGIN, 0.0));
  EXPECT_TRUE(regions.includes(9.0, -32.0 - MARGIN, 2.5));  // a square
  EXPECT_FALSE(regions.includes(9.0, -32.0 - MARGIN, 1.5));
  EXPECT_TRUE(regions.includes(-200.0, -200.0, 400.0));  // one around the disc
}

TEST(InterestRegionsTest, DiscsStayUntilAListenerLeavesTheMargin) {
  InterestRegions regions;
  regions.update({{0.0, 0.0, 30.0}});
  EXPECT_FALSE(regions.update({{0.9 * MARGIN, 0.0, 30.0}}));
  EXPECT_EQ(regions.discs().front().x, 0.0);
  EXPECT_TRUE(regions.update({{1.1 * MARGIN, 0.0, 30.0}}));
  EXPECT_EQ(regions.discs().front().x, 1.1 * MARGIN);
  EXPECT_TRUE(covers(regions.discs(), {1.1 * MARGIN, 0.0, 30.0}));
  EXPECT_TRUE(
      regions.update({{1.1 * MARGIN, 0.0, 5.0}}));  // a larger one than is wanted is dropped
}

TEST(InterestRegionsTest, ListenersInOnePlaceShareADisc) {
  InterestRegions regions;
  regions.update({{0.0, 0.0, 30.0}, {5.0, 0.0, 30.0}, {500.0, 0.0, 1.0}});
  ASSERT_EQ(regions.discs().size(), 2U);
  EXPECT_FALSE(regions.update({{5.0, 0.0, 30.0}}));  // others have gone
  EXPECT_EQ(regions.discs().size(), 1U);
  EXPECT_FALSE(regions.includes(500.0, 0.0));
  EXPECT_TRUE(regions.update({}));  // to the whole
  EXPECT_TRUE(regions.includes(500.0, 0.0));
}

}  // namespace
}  // namespace vegetation_sim
