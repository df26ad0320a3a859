// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Clients share a queue of inputs.
#include "nodes/base/event_queue.h"

#include <gtest/gtest.h>
#include <vegetation_sim/GrassEvent.h>

#include <string>
#include <vector>

#include "core/error_text.h"

namespace vegetation_sim {
namespace {

using Queue = EventQueue<GrassEvent>;
constexpr Nanoseconds TICK = NANOSECONDS_PER_SECOND / 25;
const ros::Time LATER = toStamp(55 * NANOSECONDS_PER_SECOND);

/// A queue to which several clients send.
class SharedQueue : public testing::Test {
 protected:
  /// Adds inputs until one is lost, and returns how many are accepted.
  std::size_t fill(const std::string& client, const ros::Time& stamp) {
    client_ = client;
    std::size_t out = 0;
    while (queue_.add(at(stamp))) ++out;
    return out;
  }
  static GrassEvent at(const ros::Time& stamp) {
    GrassEvent out;
    out.header.stamp = stamp;
    return out;
  }

  std::string client_;
  Queue queue_{false, &client_};
};

TEST_F(SharedQueue, AClientLeavesHalfOfTheRoomForLaterStamps) {
  EXPECT_EQ(fill("/flood", LATER), Queue::MOST_AHEAD_OF_CLIENT);
  EXPECT_EQ(queue_.losses().lost, 1u);
  client_ = "/robot";
  EXPECT_EQ(queue_.room(LATER.toNSec()), Queue::MOST_AHEAD_OF_CLIENT / 2);
  EXPECT_TRUE(queue_.add(at(toStamp(2 * TICK))));
  EXPECT_EQ(queue_.take(2 * TICK).size(), 1u);
  EXPECT_EQ(queue_.room(LATER.toNSec()), Queue::MOST_AHEAD_OF_CLIENT / 2);
}

TEST_F(SharedQueue, AClientLeavesHalfOfTheRoomForTheNextTick) {
  const ros::Time next;
  EXPECT_EQ(fill("/flood", next), Queue::MOST_OF_CLIENT);
  EXPECT_EQ(fill("/second", next), Queue::MOST_OF_CLIENT / 2);
  EXPECT_EQ(fill("/third", LATER), Queue::MOST_OF_CLIENT / 4);
  // The node's own inputs have all the room that is left.
  EXPECT_EQ(fill("", next), Queue::MOST_OF_CLIENT / 4);
  EXPECT_EQ(queue_.take(TICK).size(), Queue::MOST_WAITING - Queue::MOST_OF_CLIENT / 4);
  EXPECT_EQ(fill("/flood", next), (Queue::MOST_WAITING - Queue::MOST_OF_CLIENT / 4) / 2);
}

// The journal and snapshots do not tell whose the inputs are: what was accepted is accepted again.
TEST_F(SharedQueue, WhatIsAcceptedFitsAgainWithoutTheNamesOfClients) {
  std::vector<GrassEvent> accepted;
  queue_.observe([&](const GrassEvent& event) { accepted.push_back(event); });
  for (const char* client : {"/a", "/b", "/c"}) {
    fill(client, LATER);
    fill(client, ros::Time());
  }
  Queue again(false);
  for (const GrassEvent& event : accepted) EXPECT_TRUE(again.add(event));
  again.restore(accepted);
  EXPECT_EQ(again.take(LATER.toNSec()).size(), queue_.take(LATER.toNSec()).size());
}

// What a snapshot has restored is nobody's, so that nobody's share is full.
TEST_F(SharedQueue, RestoredInputsAreOfNoClient) {
  queue_.restore(std::vector<GrassEvent>(Queue::MOST_AHEAD_OF_CLIENT, at(LATER)));
  EXPECT_EQ(fill("/flood", LATER), Queue::MOST_AHEAD_OF_CLIENT / 2);
}

// Before the clock has begun a stamp cannot be checked.
TEST_F(SharedQueue, InputsThatAreTooFarAheadAreLostAtTheFirstTick) {
  for (const double ahead : {0.0, 1.0, 59.9, 60.1, 1e9})
    EXPECT_TRUE(queue_.add(at(toStamp(TICK + fromSeconds(ahead)))));
  EXPECT_EQ(queue_.take(TICK).size(), 1u);
  EXPECT_EQ(queue_.losses().lost, 2u);
  EXPECT_EQ(queue_.take(TICK + fromSeconds(60.0)).size(), 2u);
}

TEST_F(SharedQueue, WhatItsInputsHoldIsSharedToo) {
  constexpr std::size_t MOST = 400;
  const auto ask = [&](const char* client, std::size_t points) {
    client_ = client;
    return errorOf([&] {
      queue_.checkShare("points", points, MOST,
                        [](const GrassEvent& event) { return event.cut.outline.size(); });
      GrassEvent event;
      event.cut.outline.resize(points);
      queue_.add(event);
    });
  };
  EXPECT_EQ(ask("/flood", 150), "");
  EXPECT_EQ(ask("/flood", 50), "");
  EXPECT_EQ(ask("/flood", 1), "points = 201 with the 1 of this request, allowed are 0 to 200");
  EXPECT_EQ(ask("/robot", 100), "");
  EXPECT_EQ(ask("/robot", 1), "points = 101 with the 1 of this request, allowed are 0 to 100");
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
