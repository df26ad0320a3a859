// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services/request_checks.h"

#include <gtest/gtest.h>

#include "core/error_text.h"

namespace vegetation_sim {
namespace {

class UnknownFrame : public testing::Test {
 protected:
  static void SetUpTestSuite() { ros::Time::init(); }

  void addFrame(const std::string& name) {
    geometry_msgs::TransformStamped frame;
    frame.header.frame_id = "map";
    frame.child_frame_id = name;
    frame.header.stamp = ros::Time(1.0);
    frame.transform.rotation.w = 1.0;
    buffer_.setTransform(frame, "test");
  }
  std::string error() const {
    return errorOf([&] { poseInWorld(buffer_, "map", "nowhere"); });
  }

  tf2_ros::Buffer buffer_;
};

TEST_F(UnknownFrame, IsNamedWithTheFramesThereAre) {
  EXPECT_NE(error().find("frame_id = 'nowhere' is not known in 'map': "), std::string::npos);
  EXPECT_NE(error().find("; tf has no frames yet"), std::string::npos) << error();
  addFrame("odom");
  EXPECT_NE(error().find("; tf knows 'map', 'odom'"), std::string::npos) << error();
  for (char name = 'a'; name < 'm'; ++name) addFrame(std::string(1, name));
  EXPECT_NE(error().find("; tf knows 'a', 'b', 'c', 'd', 'e', 'f', 'g', 'h' and 6 others"),
            std::string::npos)
      << error();
}

TEST(CheckFrame, QuotesTheBeginningOfALongFrame) {
  const std::string frame(100000, 'f');
  checkFrame("map", "map");
  EXPECT_EQ(errorOf([&] { checkFrame(frame, "map"); }),
            "frame_id = " + inQuotes(frame) + ", allowed is the world frame of this node, 'map'");
}

}  // namespace
}  // namespace vegetation_sim
