// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/cover/cover_join.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error_text.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr Nanoseconds TICK = NANOSECONDS_PER_SECOND;
constexpr double DRAG = 2.0;

nav_msgs::MapMetaData grid() {
  nav_msgs::MapMetaData out;
  out.width = 2;
  out.height = 2;
  out.resolution = 0.5F;
  return out;
}

// Cell 0 is trodden.
GrassCover ownCover(Nanoseconds stamp) {
  GrassCover out;
  out.header.stamp = toStamp(stamp);
  out.info = grid();
  out.density.assign(4, 10.F);
  out.height.assign(4, 0.5F);
  out.crush = {0.5F, 0.F, 0.F, 0.F};
  out.age = {3.F, -1.F, -1.F, -1.F};
  return out;
}

GrassCoverPart partOf(std::uint32_t shard, Nanoseconds stamp, std::uint32_t cell, float crush,
                      float age) {
  GrassCoverPart out;
  out.header.stamp = toStamp(stamp);
  out.shard = shard;
  out.info = grid();
  out.cells = {cell};
  out.crush = {crush};
  out.age = {age};
  return out;
}

TEST(CoverJoin, JoinsTheCellsOfAllShardsOnceTheyHaveCome) {
  CoverJoin join(3);
  EXPECT_FALSE(join.begin(ownCover(TICK), DRAG));
  join.add(partOf(1, TICK, 0, 0.8F, 5.F));  // a cell of two shards
  EXPECT_FALSE(join.take());
  join.add(partOf(2, TICK, 3, 1.F, 1.F));
  const auto map = join.take();
  ASSERT_TRUE(map);
  EXPECT_EQ(map->crush, (std::vector<float>{0.8F, 0.F, 0.F, 1.F}));
  EXPECT_EQ(map->age, (std::vector<float>{3.F, -1.F, -1.F, 1.F}));
  EXPECT_FLOAT_EQ(map->resistance[0], 2.F * 10.F * 0.5F * 0.2F);
  EXPECT_FLOAT_EQ(map->resistance[1], 2.F * 10.F * 0.5F);
  EXPECT_EQ(map->resistance[3], 0.F);
  EXPECT_FALSE(join.take());
}

TEST(CoverJoin, TakesPartsThatComeBeforeTheMapBegins) {
  CoverJoin join(2);
  join.add(partOf(1, TICK, 1, 0.4F, 0.F));
  join.add(partOf(1, 2 * TICK, 2, 0.4F, 0.F));
  join.begin(ownCover(TICK), DRAG);
  const auto map = join.take();
  ASSERT_TRUE(map);
  EXPECT_EQ(map->crush, (std::vector<float>{0.5F, 0.4F, 0.F, 0.F}));
}

TEST(CoverJoin, ShowsALateShardAsInTheMapBefore) {
  CoverJoin join(2);
  join.add(partOf(1, TICK, 1, 0.4F, 0.F));
  join.begin(ownCover(2 * TICK), DRAG);
  EXPECT_FALSE(join.take());
  const auto map = join.begin(ownCover(3 * TICK), DRAG);
  ASSERT_TRUE(map);
  EXPECT_EQ(fromMsg(map->header.stamp), 2 * TICK);
  EXPECT_EQ(map->crush[1], 0.4F);
  const auto next = join.begin(ownCover(4 * TICK), DRAG);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->crush[1], 0.4F);  // still
}

TEST(CoverJoin, RefusesPartsByName) {
  CoverJoin join(2);
  join.begin(ownCover(TICK), DRAG);
  const auto fault = [&](const GrassCoverPart& part) { return errorOf([&] { join.add(part); }); };
  const GrassCoverPart good = partOf(1, TICK, 1, 0.4F, 0.F);
  EXPECT_EQ(fault(partOf(0, TICK, 1, 0.4F, 0.F)), "cover: shard = 0 is outside 1 to 1");
  EXPECT_EQ(fault(partOf(2, TICK, 1, 0.4F, 0.F)), "cover: shard = 2 is outside 1 to 1");
  EXPECT_EQ(fault(partOf(1, TICK, 4, 0.4F, 0.F)),
            "cover: cell = 4 is outside the grid or not in ascending order");
  GrassCoverPart part = good;
  part.age.clear();
  EXPECT_EQ(fault(part), "cover: cells, crush and age have 1, 1 and 0 entries");
  part = good;
  part.info.width = 3;
  EXPECT_EQ(fault(part),
            "cover: the grid of shard 1 differs; cover_resolution must be that of all shards");
  constexpr float NAN_VALUE = std::numeric_limits<float>::quiet_NaN();
  for (const float crush : {NAN_VALUE, -0.1F, 1.1F})
    EXPECT_NE(fault(partOf(1, TICK, 1, crush, 0.F)), "") << crush;
  for (const float age : {NAN_VALUE, -1.F, std::numeric_limits<float>::infinity()})
    EXPECT_NE(fault(partOf(1, TICK, 1, 0.4F, age)), "") << age;
  EXPECT_FALSE(join.take());
  EXPECT_EQ(fault(good), "");
  EXPECT_TRUE(join.take());
}

TEST(CoverJoin, KeepsTheEarliestPartsOfAShard) {
  CoverJoin join(2);
  for (int i = 1; i <= 1000; ++i) join.add(partOf(1, i * TICK, 1, 0.4F, 0.F));
  for (int i = 1; i <= 16; ++i) {
    join.begin(ownCover(i * TICK), DRAG);
    EXPECT_TRUE(join.take()) << i;
  }
  join.begin(ownCover(17 * TICK), DRAG);
  EXPECT_FALSE(join.take());  // its part had to go
}

TEST(CoverJoin, WaitsForTheFirstPartsOfAllShards) {
  CoverJoin join(3);
  join.begin(ownCover(TICK), DRAG);
  join.add(partOf(1, TICK, 1, 0.4F, 0.F));
  EXPECT_FALSE(join.begin(ownCover(2 * TICK), DRAG));  // shard 2 has sent nothing
  join.add(partOf(2, TICK, 2, 0.4F, 0.F));
  const auto map = join.begin(ownCover(3 * TICK), DRAG);
  ASSERT_TRUE(map);
  EXPECT_EQ(map->crush, (std::vector<float>{0.5F, 0.4F, 0.4F, 0.F}));
}

TEST(CoverJoin, ShowsAMapWithoutASilentShardAfterAWhile) {
  CoverJoin join(2);
  for (int i = 1; i <= 4; ++i) EXPECT_FALSE(join.begin(ownCover(i * TICK), DRAG)) << i;
  EXPECT_TRUE(join.begin(ownCover(5 * TICK), DRAG));
  join.clear();
  EXPECT_FALSE(join.begin(ownCover(6 * TICK), DRAG));
  EXPECT_FALSE(join.begin(ownCover(7 * TICK), DRAG));
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
