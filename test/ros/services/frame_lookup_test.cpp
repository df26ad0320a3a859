// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services/frame_lookup.h"

#include <gtest/gtest.h>

#include <future>

#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr Nanoseconds TICK = NANOSECONDS_PER_SECOND / 10;

class FrameLookupTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { ros::Time::init(); }

  // The wheel is at x = 0.1 m times the number of the tick.
  void publish(std::int64_t tick) {
    geometry_msgs::TransformStamped frame;
    frame.header.frame_id = "world";
    frame.child_frame_id = "wheel";
    frame.header.stamp = toStamp(tick * TICK);
    frame.transform.translation.x = 0.1 * static_cast<double>(tick);
    frame.transform.rotation.w = 1.0;
    buffer_.setTransform(frame, "test");
  }
  // Returns the tick whose place the wheel has.
  double find(FrameLookup& lookup, std::int64_t tick) {
    lookup.begin(tick * TICK);
    return 10.0 * lookup.find("wheel").transform.translation.x;
  }

  tf2_ros::Buffer buffer_;
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
  FrameLookup lookup(buffer_, "world", 30.0);
  publish(5);
  publish(9);
  EXPECT_DOUBLE_EQ(find(lookup, 7), 7.0);
}

TEST_F(FrameLookupTest, ATickWaitsUntilItsTransformComes) {
  FrameLookup lookup(buffer_, "world", 30.0);
  publish(5);
  auto found = std::async(std::launch::async, [&] { return find(lookup, 7); });
  EXPECT_EQ(found.wait_for(std::chrono::milliseconds(50)), std::future_status::timeout);
  publish(7);
  EXPECT_DOUBLE_EQ(found.get(), 7.0);
  EXPECT_EQ(lookup.late(), 0u);
}

TEST_F(FrameLookupTest, AfterTheWaitTheNewestTransformCounts) {
  FrameLookup lookup(buffer_, "world", 0.2);
  publish(5);
  const ros::WallTime start = ros::WallTime::now();
  EXPECT_DOUBLE_EQ(find(lookup, 7), 5.0);
  EXPECT_GE((ros::WallTime::now() - start).toSec(), 0.2);
  EXPECT_EQ(lookup.late(), 1u);
  EXPECT_THROW(lookup.find("nowhere"), tf2::TransformException);
}

// One that never comes must not delay every tick.
TEST_F(FrameLookupTest, AFrameThatWasAwaitedInVainIsAwaitedAgainWhenItHasAnotherTransform) {
  FrameLookup lookup(buffer_, "world", 0.2);
  publish(5);
  const auto wait = [&](std::int64_t tick, const std::string& frame) {
    const ros::WallTime start = ros::WallTime::now();
    lookup.begin(tick * TICK);
    try {
      lookup.find(frame);
    } catch (const tf2::TransformException&) {
    }
    return (ros::WallTime::now() - start).toSec();
  };
  for (const char* frame : {"wheel", "nowhere"}) {
    EXPECT_GE(wait(7, frame), 0.2) << frame;
    EXPECT_LT(wait(8, frame), 0.2) << frame;
  }
  EXPECT_EQ(lookup.late(), 4u);
  publish(8);
  EXPECT_LT(wait(8, "wheel"), 0.2);
  EXPECT_GE(wait(9, "wheel"), 0.2);
  EXPECT_EQ(lookup.late(), 5u);
}

}  // namespace
}  // namespace vegetation_sim
