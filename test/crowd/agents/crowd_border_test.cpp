// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Borders come from other processes, and what they hand over becomes state.
#include <gtest/gtest.h>

#include <functional>

#include "core/error_text.h"
#include "crowd/agents/crowd_shard.h"
#include "scenes/crowd/crowd_scenes.h"

namespace vegetation_sim::crowd {
namespace {

CrowdBorder handingOver(std::uint32_t first, std::size_t count) {
  CrowdBorder out;
  out.stamp = NANOSECONDS_PER_SECOND;
  for (std::size_t i = 0; i < count; ++i) {
    CrowdBorder::Handed handed;
    handed.stamp = out.stamp;
    handed.walker.id = first + static_cast<std::uint32_t>(i);
    handed.walker.position = {1.0, 1.0};
    out.handed.push_back(handed);
  }
  return out;
}

std::string errorOfBorder(const std::function<void(CrowdBorder&, Walker&)>& change) {
  CrowdBorder border = handingOver(7, 1);
  change(border, border.handed[0].walker);
  return errorOf([&] { readBorder(archiveBorder(border)); });
}

TEST(CrowdBorder, IsRefusedForValuesThatNoStateMayHave) {
  EXPECT_EQ(errorOfBorder([](CrowdBorder&, Walker&) {}), "");
  EXPECT_EQ(errorOfBorder([](CrowdBorder&, Walker& walker) { walker.id = 0xffffffff; }),
            "walker id = 4294967295 is outside 0 to 2147483647");
  EXPECT_EQ(errorOfBorder([](CrowdBorder& border, Walker&) {
              border.ids = {1, 0xfffffffe};
            }),
            "id = 4294967294 is outside 0 to 2147483647");
  EXPECT_EQ(errorOfBorder([](CrowdBorder&, Walker& walker) { walker.position.y = 1e300; }),
            "walker position = 1e+300 is outside -110000 to 110000");
  EXPECT_EQ(errorOfBorder([](CrowdBorder& border, Walker& walker) {
              walker.position.x = -2e5;
              border.near = {walker};
              border.handed.clear();
            }),
            "walker position = -200000 is outside -110000 to 110000");
  EXPECT_EQ(errorOfBorder([](CrowdBorder&, Walker& walker) { walker.goal.x = 1e10; }),
            "walker goal = 1e+10 is outside -110000 to 110000");
  EXPECT_EQ(errorOfBorder([](CrowdBorder&, Walker& walker) { walker.velocity.x = 1e4; }),
            "walker velocity = 10000 is outside -1000 to 1000");
  EXPECT_EQ(errorOfBorder([](CrowdBorder&, Walker& walker) { walker.heading = 1e200; }),
            "walker heading = 1e+200 is outside -1000 to 1000");
  EXPECT_EQ(errorOfBorder([](CrowdBorder&, Walker& walker) { walker.feet[1].offset.y = 1e3; }),
            "foot offset = 1000 is outside -100 to 100");
}

/// Shard 0 of two.
struct Receiver {
  Crowd crowd{1, CrowdSettings(), {0.0, 20.0, 0.0, 20.0}, flatGround()};
  CrowdShard shard{crowd, {0, 2}};
};

TEST(CrowdBorder, TheLargestIdLeavesAStateThatCanBeRead) {
  Receiver receiver;
  EXPECT_EQ(receiver.shard.hear(1, handingOver(LARGEST_ID, 1)), 0u);
  ASSERT_EQ(receiver.crowd.walkers().size(), 1u);
  EXPECT_EQ(errorOf([&] { receiver.crowd.spawn(Spawn()); }),
            "spawn: id = 2147483648 is outside 0 to 2147483647");
  receiver.crowd.keepIdsFree(0xffffffff);
  EXPECT_EQ(Crowd::readArchived(receiver.crowd.archived()).hash(),
            receiver.crowd.snapshot().hash());
}

TEST(CrowdBorder, PeopleForWhomThereIsNoRoomAreCounted) {
  Receiver receiver;
  receiver.shard.hear(1, handingOver(0, MOST_WALKERS - 1));
  CrowdBorder more = handingOver(1u << 20, 3);
  for (CrowdBorder::Handed& handed : more.handed) ++handed.stamp;
  ++more.stamp;
  EXPECT_EQ(receiver.shard.hear(1, more), 2u);
  EXPECT_EQ(receiver.crowd.walkers().size(), MOST_WALKERS);
  EXPECT_EQ(errorOf([&] { receiver.crowd.takeIn(more.handed[1].walker); }),
            "walkers = 100000 are there, which is the most allowed");
  EXPECT_EQ(Crowd::readArchived(receiver.crowd.archived()).walkers.size(), MOST_WALKERS);
}

// People on the way to a silent shard are part of the state as well.
TEST(CrowdBorder, PeopleOnTheWayTakeRoom) {
  Receiver receiver;
  CrowdBorder border = handingOver(0, MOST_WALKERS);
  for (CrowdBorder::Handed& handed : border.handed) handed.walker.position = {19.0, 19.0};
  receiver.shard.hear(1, border);
  receiver.shard.endTick();
  ASSERT_EQ(receiver.shard.handed().size(), MOST_WALKERS);
  CrowdBorder more = handingOver(1u << 20, 3);
  for (CrowdBorder::Handed& handed : more.handed) ++handed.stamp;
  ++more.stamp;
  EXPECT_EQ(receiver.shard.hear(1, more), 3u);
  Archive state;
  EXPECT_EQ(errorOf([&] { receiver.shard.archive(state); }), "");
}

}  // namespace
}  // namespace vegetation_sim::crowd
