// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The ranges of dynamic_reconfigure are those of the structures in the node, and queues of inputs
// are bounded.
#include <gtest/gtest.h>
#include <vegetation_sim/GrassEvent.h>
#include <vegetation_sim/GrassFieldConfig.h>

#include <string>

#include "core/config/field_values.h"
#include "core/error_text.h"
#include "nodes/base/event_queue.h"
#include "nodes/grass/grass_options.h"
#include "nodes/grass/waiting_areas.h"
#include "nodes/rigs/declared_fields.h"

namespace vegetation_sim {
namespace {

using Queue = EventQueue<GrassEvent>;
constexpr Nanoseconds TICK = NANOSECONDS_PER_SECOND / 25;

GrassEvent at(std::int64_t tick) {
  GrassEvent out;
  out.header.stamp = toStamp(tick * TICK);
  return out;
}

TEST(GrassRanges, MatchDynamicReconfigure) {
  GrassTuning tuning;
  Declared declared;
  describe(declared, tuning);
  EXPECT_EQ(offered(GrassFieldConfig::__getMin__()), declared.low);
  EXPECT_EQ(offered(GrassFieldConfig::__getMax__()), declared.high);
  EXPECT_EQ(offered(GrassFieldConfig::__getDefault__()), declared.defaults);
}

TEST(GrassRanges, SettingsSurviveTheirEventAndTheirConfig) {  // N6
  GrassTuning tuning;
  tuning.drag = 0.5;
  tuning.height_gate = 0.1;
  tuning.tread = {0.2, 0.6, 0.15, 0.8, 90.0};
  tuning.view = {2.5, 0.25, 90.0, tuning.view.most_blades};
  GrassFieldConfig config;
  toConfig(tuning, config);
  GrassTuning by_event = fromNamedValues<GrassTuning>(namedValues(tuning));
  GrassTuning by_config = fromConfig(config, GrassTuning().view);
  Declared sent, event, reconfigured;
  describe(sent, tuning);
  describe(event, by_event);
  describe(reconfigured, by_config);
  EXPECT_EQ(sent.defaults, event.defaults);
  EXPECT_EQ(sent.defaults, reconfigured.defaults);
}

// N6: an event of a replay is in time at its own tick and late after it.
TEST(EventQueue, CountsLateEventsOfAReplay) {
  Queue queue(true);
  for (const std::int64_t tick : {101, 102, 104}) queue.addRecorded(at(tick));
  EXPECT_TRUE(queue.add(at(0)));  // A live input has no effect.
  EXPECT_TRUE(queue.take(100 * TICK).empty());
  EXPECT_EQ(queue.take(101 * TICK).size(), 1u);
  EXPECT_EQ(queue.take(102 * TICK).size(), 1u);
  EXPECT_EQ(queue.losses().late, 0u);
  queue.addRecorded(at(99));
  EXPECT_EQ(queue.take(105 * TICK).size(), 2u);
  EXPECT_EQ(queue.losses().late, 2u);
}

TEST(EventQueue, LiveInputsGetTheStampOfTheirTickAndKeepTheirOrder) {
  Queue queue(false);
  for (const double radius : {1.0, 2.0, 3.0}) {
    GrassEvent event = at(radius == 2.0 ? 8 : 0);
    event.radius = radius;
    EXPECT_TRUE(queue.add(event));
  }
  queue.addRecorded(at(1));  // The node receives its own events.
  const std::vector<GrassEvent> now = queue.take(7 * TICK), later = queue.take(8 * TICK);
  ASSERT_EQ(now.size(), 2u);
  EXPECT_EQ(now[0].radius, 1.0);
  EXPECT_EQ(now[1].radius, 3.0);
  EXPECT_EQ(now[1].header.stamp, toStamp(7 * TICK));
  ASSERT_EQ(later.size(), 1u);
  EXPECT_EQ(later[0].radius, 2.0);
}

TEST(EventQueue, IsBoundedAndCountsRejectedInputs) {
  Queue live(false), replay(true);
  for (std::size_t i = 0; i < Queue::MOST_WAITING; ++i) EXPECT_TRUE(live.add(at(0)));
  EXPECT_EQ(live.room(), 0u);
  EXPECT_FALSE(live.add(at(0)));
  EXPECT_EQ(live.losses().lost, 1u);
  EXPECT_EQ(live.take(TICK).size(), Queue::MOST_WAITING);
  for (std::size_t i = 0; i < Queue::MOST_WAITING + 3; ++i) replay.addRecorded(at(1));
  EXPECT_EQ(replay.losses().lost, 3u);
  replay.forget([](const GrassEvent&) { return true; });
  EXPECT_TRUE(replay.take(TICK).empty());
}

// Returns whether the waiting events have this cost.
bool costs(const Queue& queue, std::size_t cost) {
  const std::size_t most = 100;
  const auto fits = [&](std::size_t more) {
    return errorOf([&] { queue.checkCost("cost", more, most); }).empty();
  };
  return fits(most - cost) && !fits(most - cost + 1);
}

// A cost is counted while its event waits, however that comes and goes.
TEST(EventQueue, AddsUpWhatWaits) {
  Queue queue(false);
  queue.setCost([](const GrassEvent& event) { return static_cast<std::size_t>(event.radius); });
  GrassEvent soon = at(0), later = at(9);
  soon.radius = 2.0;
  later.radius = 30.0;
  queue.add(soon);
  queue.add(later);
  queue.addFirst(soon);
  EXPECT_TRUE(costs(queue, 34));
  queue.take(3 * TICK);
  EXPECT_TRUE(costs(queue, 30));
  queue.restore({soon, later, later});
  EXPECT_TRUE(costs(queue, 62));
  queue.forget([](const GrassEvent& event) { return event.radius == 2.0; });
  EXPECT_TRUE(costs(queue, 60));
  queue.take(9 * TICK);
  EXPECT_TRUE(costs(queue, 0));
}

TEST(WaitingAreas, TheirWorkIsBoundedTogether) {
  Queue queue(false);
  queue.setCost([](const GrassEvent& event) { return static_cast<std::size_t>(event.radius); });
  GrassEvent event;
  event.radius = MOST_WAITING_WORK - 5.0;
  queue.add(event);
  EXPECT_NO_THROW(checkWorkToWait(queue, 5.0));
  try {
    checkWorkToWait(queue, 6.0);
    FAIL() << "one node more may wait";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.code(), FaultCode::NO_ROOM);
    EXPECT_STREQ(error.what(),
                 "nodes of treads and cuts that wait = 100000001 with the 6 of this request, "
                 "allowed are 0 to 100000000");
  }
  EXPECT_THROW(checkRoomToWait(queue, GrassCut(), 6.0), InvalidInput);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
