// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/canopy/stalk_strips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vegetation_sim::view {
namespace {

constexpr double FOOT = 0.5, SCALE = 1.5, TALL = 2.4 * SCALE;  // [m]

canopy::PlantKind maize() {
  canopy::PlantKind out;
  out.shape = canopy::PlantShape::STALK;
  out.height = 2.4;
  out.radius = 0.6;
  out.leaves = 14;
  out.pieces = 5;
  out.leaf_length = 0.9;
  out.leaf_width = 0.09;
  out.stems = 7;
  out.stem_radius = 0.012;
  return out;
}

canopy::Plant plant() {
  canopy::Plant out;
  out.seed = 7;
  out.position = Vec3(3.0, -2.0, FOOT);
  out.yaw = 0.4;
  out.scale = SCALE;
  return out;
}

std::vector<StalkStrip> stripsCutAt(double height) {
  return stalkStrips(maize(), plant(), height, canopy::grow(maize(), plant(), height));
}

double wayFromAxis(const Vec3& at) {
  return std::hypot(at.x() - 3.0, at.y() + 2.0);
}

/// Returns the heights above the foot at which the pieces of the stalk end, from below.
std::vector<double> endsOfStalk(const std::vector<StalkStrip>& strips) {
  std::vector<double> out{0.0};
  for (const StalkStrip& strip : strips) {
    if (strip.face < 0) continue;
    EXPECT_LT(wayFromAxis(strip.leaf.tip), 0.03 * SCALE);
    if (strip.face > 0) continue;
    EXPECT_NEAR(strip.leaf.root.z() - FOOT, out.back(), 1e-9);
    out.push_back(strip.leaf.tip.z() - FOOT);
  }
  return out;
}

// The stalk is one piece from the ground to its tassel, or to where it is cut.
TEST(StalkStrips, TheStalkReachesFromTheGroundToItsTop) {
  const std::vector<double> whole = endsOfStalk(stripsCutAt(canopy::UNCUT));
  EXPECT_NEAR(whole.back(), 0.92 * TALL, 1e-9);
  EXPECT_GE(whole.size(), 3U);
  EXPECT_NEAR(endsOfStalk(stripsCutAt(0.3)).back(), 0.3, 1e-9);
  EXPECT_EQ(endsOfStalk(stripsCutAt(0.0)).size(), 1U);
}

// At its foot a blade is about as wide as its stalk, below where it leaves it. Blades of one plant
// turn by different angles.
TEST(StalkStrips, BladesNarrowToTheStalk) {
  const canopy::GrownPlant grown = canopy::grow(maize(), plant());
  int feet = 0;
  double least = 1.0, most = -1.0;
  for (const StalkStrip& strip : stripsCutAt(canopy::UNCUT)) {
    const double half = length(strip.leaf.side);
    if (strip.face >= 0 || half < 0.03 || wayFromAxis(strip.leaf.root) > 1e-6) continue;
    ++feet;
    const double width = static_cast<double>(strip.leaf.root_width) * half;
    EXPECT_LT(width, 1.6 * SCALE * 0.012);
    EXPECT_GT(width, 0.4 * SCALE * 0.012);
    EXPECT_GT(static_cast<double>(strip.leaf.tip_width) * half, 1.8 * width);
    const auto same = [&](const canopy::Leaf& leaf) { return leaf.tip == strip.leaf.tip; };
    const auto piece = std::find_if(grown.leaves.begin(), grown.leaves.end(), same);
    ASSERT_NE(piece, grown.leaves.end());
    EXPECT_LT(strip.leaf.root.z(), piece->root.z());
    EXPECT_GT(strip.leaf.root.z(), FOOT);
    least = std::min(least, static_cast<double>(strip.roll[1].sin));
    most = std::max(most, static_cast<double>(strip.roll[1].sin));
  }
  EXPECT_EQ(feet, 14);
  EXPECT_LT(least, -0.02);
  EXPECT_GT(most, 0.02);
}

// Leaves have less light and darker colours near the ground, and other normals at each end and
// edge.
TEST(StalkStrips, LightFallsOffTowardsTheGround) {
  double low = 0.0, low_green = 0.0, high = 1.0, high_green = 1.0;
  for (const StalkStrip& strip : stripsCutAt(canopy::UNCUT)) {
    for (std::size_t end = 0; end < 2; ++end) {
      const double share = ((end == 0 ? strip.leaf.root : strip.leaf.tip).z() - FOOT) / TALL;
      const double light = strip.paint.light[end], green = strip.paint.colours[end].y();
      if (strip.face < 0 && length(strip.leaf.side) < 0.03) continue;
      if (share < 0.1) low = std::max(low, light), low_green = std::max(low_green, green);
      if (share > 0.8) high = std::min(high, light), high_green = std::min(high_green, green);
    }
    for (const Vec3& normal : strip.paint.normals) EXPECT_NEAR(length(normal), 1.0, 1e-9);
    if (strip.face < 0 && length(strip.leaf.side) > 0.03) {
      EXPECT_LT(dot(strip.paint.normals[0], strip.paint.normals[1]), 0.8);
      EXPECT_GT(strip.paint.normals[0].z() + strip.paint.normals[1].z(), 0.0);
    }
  }
  EXPECT_LT(low, 0.6 * high);
  EXPECT_GT(low, 0.1);
  EXPECT_LT(low_green, high_green);
}

// What is cut off keeps its strips and lies; stubble is in the light.
TEST(StalkStrips, WhatIsCutOffLies) {
  const canopy::GrownPlant grown = canopy::grow(maize(), plant(), 0.3);
  const std::vector<StalkStrip> strips = stripsCutAt(0.3);
  const auto lying = std::count_if(grown.leaves.begin(), grown.leaves.end(),
                                   [](const canopy::Leaf& leaf) { return leaf.lies; });
  ASSERT_GT(lying, 50);
  EXPECT_EQ(std::count_if(strips.begin(), strips.end(),
                          [](const StalkStrip& strip) { return strip.leaf.lies; }),
            lying);
  for (const StalkStrip& strip : strips) EXPECT_TRUE(strip.face < 0 || strip.paint.light[0] == 1.0);
}

}  // namespace
}  // namespace vegetation_sim::view
