// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Ranges of a lidar to wood against those to the full model: every joint of every tree physical.
#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "scenes/sensors/range_error_scene.h"

namespace vegetation_sim::scan {
namespace {

constexpr int RATE = 30, WARM_UP = 8 * RATE, MEASURED = 8 * RATE, EVERY = 12;

forest::Layout bareTrees() {
  forest::Layout out = forest::gridLayout(2, 8.0);
  for (forest::Species& species : out.species) species.leaf_size = 0.001;
  return out;
}

RangeLidar lidarAmongBareTrees() {
  RangeLidar out;
  out.place = Vec3(4.0, 4.0, 1.5);
  out.beams.rings = 48;
  out.beams.columns = 720;
  out.beams.elevation_low = -0.1;
  out.beams.elevation_high = 1.0;
  return out;
}

// N1: with a sensor that has announced itself, what 99 % of the rays to wood meet in the full model
// is within the tolerance of its place, and so are the ranges of those that meet the same branch;
// without, far fewer are. A ray past a thin branch may meet one behind it, at any range.
TEST(RangeError, ToleranceHoldsForNinetyNinePercentOfTheRaysToWood) {
  const wind::Field wind({forest::makeBreeze(1, Vec3(6.0, 2.0, 0.0))}, 3);
  const forest::Layout layout = bareTrees();
  const RangeLidar lidar = lidarAmongBareTrees();
  const auto flat = forest::flatTerrain();
  SensedForest full(layout, flat, wind), announced(layout, flat, wind), silent(layout, flat, wind);
  makeWhole(full.forest(), {0, 1, 2, 3});
  RangeErrors near, far;
  const TickGrid grid(RATE);
  const std::int64_t first = grid.tickAt(START);
  for (int i = 0; i < WARM_UP + MEASURED; ++i) {
    const Nanoseconds stamp = grid.timeOf(first + i);
    announced.forest().setSensor({"lidar", lidar.place, lidar.range, lidar.tolerance, stamp});
    for (SensedForest* each : {&full, &announced, &silent}) each->advance(stamp, i % RATE == 0);
    if (i < WARM_UP || i % EVERY != 0) continue;
    for (SensedForest* each : {&full, &announced, &silent}) each->pose(lidar, stamp);
    addErrors(lidar, full, announced, near);
    addErrors(lidar, full, silent, far);
  }
  for (RangeErrors* each : {&near, &far})
    std::printf(
        "%s: %zu rays to wood, 99 %% displaced by up to %.1f mm; %.1f %% meet the same branch, "
        "mean "
        "%.1f mm, 99 %% %.1f mm\n",
        each == &near ? "announced" : "silent", each->wood, 1e3 * quantileOf(each->displaced, 0.99),
        100.0 * static_cast<double>(each->all.size()) / static_cast<double>(each->wood),
        1e3 * each->mean(), 1e3 * quantileOf(each->all, 0.99));
  EXPECT_GT(near.wood, 10000u);
  EXPECT_GT(near.all.size(), near.wood / 2);
  EXPECT_LE(quantileOf(near.displaced, 0.99), lidar.tolerance);
  EXPECT_LE(quantileOf(near.all, 0.99), lidar.tolerance);
  EXPECT_GT(far.mean(), 1.5 * near.mean());
  EXPECT_GT(quantileOf(far.all, 0.99), lidar.tolerance);
}

// N1: in the scenario `forest` as it is shipped, around a lidar in its clearing. range_bench has
// all of its trees.
TEST(RangeError, InTheForestToleranceHoldsWhoeverLooks) {
  const scenes::ShippedScene scene = scenes::loadShippedScene("forest");
  const RangeLidar lidar = lidarInForest(scene, 12.0);
  const WatchedErrors found = compareWatched(scene, lidar, 4, 2, 64);
  printWatched(lidar, 64, found);
  EXPECT_GT(found.trees, 8u);
  EXPECT_EQ(found.broken, 0u);  // of trees with the strength of green wood, by wind alone
  EXPECT_EQ(found.hashes, 0u);
  EXPECT_EQ(found.hits, 0u);
  for (const RangeErrors& errors : found.errors) {
    EXPECT_GT(errors.wood, 500u);
    EXPECT_LE(quantileOf(errors.displaced, 0.99), lidar.tolerance);
    EXPECT_LE(quantileOf(errors.all, 0.99), lidar.tolerance);
  }
}

}  // namespace
}  // namespace vegetation_sim::scan
