// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services/frame_lookup.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <future>
#include <map>
#include <string>
#include <vector>

#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr Nanoseconds TICK = NANOSECONDS_PER_SECOND / 10;

class FrameLookupTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { ros::Time::init(); }

  // The wheel is at x = 0.1 m times the number of the tick.
  void publish(double tick) {
    geometry_msgs::TransformStamped frame;
    frame.header.frame_id = "world";
    frame.child_frame_id = "wheel";
    frame.header.stamp = toStamp(fromSeconds(tick * secondsBetween(0, TICK)));
    frame.transform.translation.x = 0.1 * tick;
    frame.transform.rotation.w = 1.0;
    buffer_.setTransform(frame, "test");
  }
  // At a wall time [s] while a tick waits.
  void publishAt(double wall, double tick) { due_.emplace(wall, tick); }

  // Its time passes only while a tick waits.
  FrameLookup::WallClock clock() {
    return {[this] { return wall_; },
            [this](double seconds) {
              wall_ += seconds;
              for (; !due_.empty() && due_.begin()->first <= wall_; due_.erase(due_.begin()))
                publish(due_.begin()->second);
            }};
  }
  // Returns the tick whose place the wheel has, or -1 if it has none.
  static double find(FrameLookup& lookup, std::int64_t tick, const std::string& frame = "wheel") {
    lookup.begin(tick * TICK);
    try {
      return 10.0 * lookup.find(frame).transform.translation.x;
    } catch (const tf2::TransformException&) {
      return -1.0;
    }
  }
  // Returns the ticks up to `last` that wait in vain for a frame from the first one on.
  std::vector<std::int64_t> vainTicks(FrameLookup& lookup, const std::string& frame,
                                      std::int64_t first, std::int64_t last) {
    std::vector<std::int64_t> out;
    for (std::int64_t tick = first; tick <= last; ++tick) {
      const double start = wall_;
      find(lookup, tick, frame);
      if (wall_ > start) out.push_back(tick);
    }
    return out;
  }

  tf2_ros::Buffer buffer_;
  double wall_{0.0};
  std::multimap<double, double> due_;
};

TEST_F(FrameLookupTest, WithoutAWaitTheNewestTransformCounts) {
  FrameLookup lookup(buffer_, "world", 0.0);
  publish(5);
  EXPECT_DOUBLE_EQ(find(lookup, 7), 5.0);
  publish(9);
  EXPECT_DOUBLE_EQ(find(lookup, 7), 9.0);
  EXPECT_EQ(lookup.late(), 0u);
}

TEST_F(FrameLookupTest, WithAWaitTheTransformIsThatOfTheTick) {
  FrameLookup lookup(buffer_, "world", 30.0, clock());
  publish(5);
  publish(9);
  EXPECT_DOUBLE_EQ(find(lookup, 7), 7.0);
  EXPECT_EQ(wall_, 0.0);
}

TEST_F(FrameLookupTest, ATickWaitsUntilItsTransformComes) {
  FrameLookup lookup(buffer_, "world", 30.0, clock());
  publish(5);
  publishAt(20.0, 7);
  EXPECT_DOUBLE_EQ(find(lookup, 7), 7.0);
  EXPECT_NEAR(wall_, 20.0, 0.01);
  EXPECT_EQ(lookup.late(), 0u);
}

TEST_F(FrameLookupTest, ATransformThatAnotherThreadAddsEndsTheWait) {
  FrameLookup lookup(buffer_, "world", FrameLookup::LONGEST_WAIT);
  publish(5);
  auto found = std::async(std::launch::async, [&] { return find(lookup, 7); });
  publish(7);
  EXPECT_DOUBLE_EQ(found.get(), 7.0);
}

TEST_F(FrameLookupTest, AfterTheWaitTheNewestTransformUpToTheTickCounts) {
  FrameLookup lookup(buffer_, "world", 0.2, clock());
  publish(5);
  EXPECT_DOUBLE_EQ(find(lookup, 7), 5.0);
  EXPECT_NEAR(wall_, 0.2, 0.01);
  EXPECT_EQ(lookup.late(), 1u);
  EXPECT_THROW(lookup.find("nowhere"), tf2::TransformException);
}

TEST_F(FrameLookupTest, AFrameThatBeginsAfterTheTickIsMissing) {
  FrameLookup lookup(buffer_, "world", 0.2, clock());
  publish(7.5);
  EXPECT_EQ(find(lookup, 7), -1.0);
  publish(8);
  EXPECT_DOUBLE_EQ(find(lookup, 8), 8.0);
}

// One that never comes must not delay every tick.
TEST_F(FrameLookupTest, AMissingFrameIsAwaitedEachTimeItHasBeenMissingTwiceAsLong) {
  FrameLookup lookup(buffer_, "world", 0.1, clock());
  publish(5);
  const std::vector<std::int64_t> ticks{6, 7, 8, 10, 14, 22, 32, 42, 52};  // a pause of at most 1 s
  EXPECT_EQ(vainTicks(lookup, "wheel", 6, 60), ticks);
  EXPECT_EQ(lookup.late(), 55u);
  FrameLookup patient(buffer_, "world", 0.2, clock());
  const std::vector<std::int64_t> rarer{106, 107, 108, 110, 114, 122, 138, 158, 178, 198};  // 2 s
  EXPECT_EQ(vainTicks(patient, "nowhere", 106, 200), rarer);
}

TEST_F(FrameLookupTest, AFrameIsAwaitedOnceInATick) {
  FrameLookup lookup(buffer_, "world", 0.1, clock());
  publish(5);
  EXPECT_DOUBLE_EQ(find(lookup, 7), 5.0);
  publish(7);
  EXPECT_DOUBLE_EQ(10.0 * lookup.find("wheel").transform.translation.x, 5.0);
  EXPECT_DOUBLE_EQ(find(lookup, 8), 7.0);
}

TEST_F(FrameLookupTest, AfterAJumpBackAllFramesAreAwaited) {
  FrameLookup lookup(buffer_, "world", 0.1, clock());
  vainTicks(lookup, "wheel", 50, 60);
  buffer_.clear();
  publish(3);
  EXPECT_DOUBLE_EQ(find(lookup, 3), 3.0);
}

// The wheel is missing for ticks 6 to 19 and 31 to 33, and comes a given time after the beginning
// of each other tick.
TEST_F(FrameLookupTest, AMissingFrameThatReturnsCountsAtTheSameTicksHoweverFastItComes) {
  const double wait = 0.1;
  std::vector<std::vector<double>> runs;
  for (const double delay : {0.0, 0.001, 0.05, 0.099}) {
    buffer_.clear();
    due_.clear();
    FrameLookup lookup(buffer_, "world", wait, clock());
    std::vector<double> places;
    for (std::int64_t tick = 0; tick < 60; ++tick) {
      // What came after the tick before has come by now, if all of the wait has passed since.
      for (; !due_.empty(); due_.erase(due_.begin())) publish(due_.begin()->second);
      if (tick < 6 || (tick >= 20 && tick != 31 && tick != 32 && tick != 33)) {
        if (delay == 0.0)
          publish(static_cast<double>(tick));
        else
          publishAt(wall_ + delay, static_cast<double>(tick));
      }
      places.push_back(find(lookup, tick));
    }
    runs.push_back(places);
  }
  for (const auto& run : runs) EXPECT_EQ(run, runs.front());
  for (std::int64_t tick = 0; tick < 60; ++tick) {
    const double place = tick < 6 ? tick : tick < 22 ? 5 : tick < 31 ? tick : tick < 35 ? 30 : tick;
    EXPECT_NEAR(runs.front()[static_cast<std::size_t>(tick)], place, 1e-9) << tick;
  }
}

}  // namespace
}  // namespace vegetation_sim
