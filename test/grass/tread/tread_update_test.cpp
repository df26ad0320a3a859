// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/tread/tread_update.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scenes/grass/tread_simulation_fixture.h"

namespace vegetation_sim::grass {
namespace {

/// Trodden ground as another process rebuilds it (design: state is small, so replicate it).
class TreadUpdateTest : public FieldTest {
 protected:
  std::uint64_t groundHash(const TreadMap& map) const {
    return hashOf(snapshotTreads(map.state(), now()));
  }
  TreadMap other_{makeMap()};
  TreadReplica replica_;
};

TEST_F(TreadUpdateTest, KeyFrameAndDeltasRebuildTheGroundToTheBit) {
  drive("a", 3.0, 5.0, 1.0, 20);
  EXPECT_TRUE(replica_.apply(field_.update(true), other_));
  for (int i = 0; i < 60; ++i) {
    ++tick_;
    field_.apply(input("a", 3.7 + i / 30.0, 5.0 + i / 60.0), now());
    if (i % 3 == 0) field_.apply(input("b", 5.0, 4.0 + i / 15.0), now());
    field_.advance(now());
    const TreadUpdate update = field_.update(false);
    EXPECT_FALSE(update.key_frame);
    ASSERT_TRUE(replica_.apply(update, other_)) << replica_.why();
    ASSERT_EQ(groundHash(other_), groundHash(map_)) << i;
  }
  EXPECT_GT(snapshotTreads(map_.state(), now()).blocks.size(), 5u);
  EXPECT_EQ(replica_.stampOf(0), now());
}

TEST_F(TreadUpdateTest, ADeltaHoldsOnlyWhatWasPressedSince) {
  drive("a", 3.0, 5.0, 2.0, 150);
  std::size_t all = 0, few = 0;
  for (const TreadBlockDelta& block : field_.update(true).treads.blocks) all += block.nodes.size();
  drive("a", 13.0, 5.0, 1.0, 1);
  for (const TreadBlockDelta& block : field_.update(false).treads.blocks) few += block.nodes.size();
  EXPECT_GT(few, 50u);
  EXPECT_LT(few, all / 5);
  field_.advance(now());
  EXPECT_TRUE(field_.update(false).treads.blocks.empty());
}

TEST_F(TreadUpdateTest, AfterALostMessageItWaitsForAKeyFrame) {
  drive("a", 3.0, 5.0, 1.0, 20);
  const TreadUpdate first = field_.update(false);
  EXPECT_FALSE(replica_.apply(first, other_));
  EXPECT_EQ(replica_.why(), "no key frame yet");
  EXPECT_TRUE(replica_.apply(field_.update(true), other_));
  drive("a", 3.7, 5.0, 1.0, 3);
  field_.update(false);  // lost
  drive("a", 3.8, 5.0, 1.0, 3);
  EXPECT_FALSE(replica_.apply(field_.update(false), other_));
  EXPECT_EQ(replica_.why(), "messages were lost");
  EXPECT_TRUE(replica_.apply(field_.update(true), other_));
  EXPECT_EQ(groundHash(other_), groundHash(map_));
}

// What a listener far from the rest receives: the blocks near it, to the bit.
TEST_F(TreadUpdateTest, SelectedBlocksAreThoseOfTheWhole) {
  drive("a", 3.0, 5.0, 2.0, 150);
  drive("b", 5.0, 8.0, 1.0, 30);
  const int limit = 8;
  const BlockFilter is_near = [&](int, int column) { return column < limit; };
  const TreadUpdate near = field_.keyFrameOf(is_near);
  EXPECT_TRUE(near.key_frame);
  const TreadUpdate whole = field_.update(true);
  const TreadDelta selected = selectBlocks(whole.treads, is_near);
  EXPECT_EQ(near.hash, hashOf(selected));
  EXPECT_EQ(near.layout_hash, whole.layout_hash);
  EXPECT_EQ(near.stamp, whole.stamp);
  const std::size_t blocks = near.treads.blocks.size();
  EXPECT_GT(blocks, 2u);
  EXPECT_LT(blocks, whole.treads.blocks.size());
  EXPECT_LT(selected.presses.size(), whole.treads.presses.size());
  const BlockFilter is_far = [&](int, int column) { return column >= limit; };
  EXPECT_EQ(near.hash + hashOf(selectBlocks(whole.treads, is_far)), whole.hash);
  Faults faults;
  check(selected, faults);
  EXPECT_TRUE(faults.empty());
  EXPECT_EQ(selectBlocks(whole.treads, [](int, int) { return false; }).presses.size(), 0u);
}

// Recovered grass is not included, and a replica frees it by itself.
TEST_F(TreadUpdateTest, RecoveredGrassIsNotIncluded) {
  drive("a", 3.0, 5.0, 1.0, 20);
  tick_ += 30 * 61;
  EXPECT_TRUE(snapshotTreads(map_.state(), now()).blocks.empty());
  EXPECT_TRUE(snapshotTreads(map_.state(), now()).presses.empty());
}

TEST_F(TreadUpdateTest, ImpossibleValuesAreRejected) {
  drive("a", 3.0, 5.0, 1.0, 5);
  TreadDelta bad = field_.update(true).treads;
  Faults none;
  check(bad, none);
  EXPECT_TRUE(none.empty()) << none.text();
  bad.blocks[0].nodes[0].press = 99;
  bad.blocks[0].nodes[1].tilt = std::nanf("");
  bad.blocks[0].nodes.pop_back();
  bad.blocks[0].row = std::numeric_limits<int>::max();  // its nodes would have no whole numbers
  bad.presses[0].recovery = -1.f;
  Faults faults;
  check(bad, faults);
  for (const char* part : {"press = 99", "a tilt or direction is impossible", "nodes where",
                           "recovery = -1 s", "row and column are outside 0 to"})
    EXPECT_NE(faults.text().find(part), std::string::npos) << part << " in " << faults.text();
}

TEST_F(TreadUpdateTest, NodesOffTheMapOrWithoutMemoryAreLeftOut) {
  EXPECT_TRUE(map_.put(400, 400, {1.f, 1.f, 0.f, 60.f, START}));
  EXPECT_FALSE(map_.put(401, 400, {1.f, 1.f, 0.f, 60.f, START}));
  EXPECT_FALSE(map_.put(-1, 0, {1.f, 1.f, 0.f, 60.f, START}));
  TreadMap small = makeMap(0.05, 1e5);
  int taken = 0;
  for (int block = 0; block < 25; ++block)
    taken += small.put(16 * block, 0, {1.f, 1.f, 0.f, 60.f, START});
  EXPECT_EQ(taken, 16);
  EXPECT_EQ(map_.at({20.0, 20.0}, START).tilt, 1.f);
}

}  // namespace
}  // namespace vegetation_sim::grass
