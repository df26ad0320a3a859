// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/listeners/viewer_registry.h"

#include <gtest/gtest.h>

#include <limits>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {
namespace {

constexpr Nanoseconds SECOND = NANOSECONDS_PER_SECOND;

Viewer viewer(const std::string& id) {
  Viewer out;
  out.id = id;
  out.header.frame_id = "map";
  out.pose.orientation.w = 1.0;
  out.field_of_view = 0.8;
  out.height = 900;
  return out;
}

struct ViewerRegistryTest : testing::Test {
  void receive(const Viewer& message, Nanoseconds stamp) {
    viewers.hear(message, buffer, "map", stamp);
  }
  tf2_ros::Buffer buffer{ros::Duration(10.0), false};
  ViewerRegistry viewers;
};

// N8
TEST_F(ViewerRegistryTest, SilentViewersExpire) {
  receive(viewer("eye"), 10 * SECOND);
  EXPECT_EQ(viewers.eyesAt(13 * SECOND).size(), 1u);
  EXPECT_EQ(viewers.eyesAt(13 * SECOND + 1).size(), 0u);
}

TEST_F(ViewerRegistryTest, ViewersBeforeTheFirstTickExpireAfterIt) {
  receive(viewer("eye"), 0);
  EXPECT_EQ(viewers.eyesAt(1000 * SECOND).size(), 1u);
  EXPECT_EQ(viewers.eyesAt(1003 * SECOND).size(), 1u);
  EXPECT_EQ(viewers.eyesAt(1003 * SECOND + 1).size(), 0u);
}

TEST_F(ViewerRegistryTest, OneAboveTheLimitIsRejectedAndTheOthersStay) {
  for (std::size_t i = 0; i < ViewerRegistry::MOST; ++i) receive(viewer(std::to_string(i)), SECOND);
  EXPECT_THROW(receive(viewer("late"), SECOND), InvalidInput);
  receive(viewer("0"), SECOND);  // This is one of the known viewers.
  EXPECT_EQ(viewers.size(), ViewerRegistry::MOST);
}

TEST_F(ViewerRegistryTest, BadViewersAreRefused) {
  Viewer of_nowhere = viewer("eye"), not_a_number = viewer("eye");
  of_nowhere.header.frame_id = "nowhere";
  not_a_number.field_of_view = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(receive(of_nowhere, SECOND), InvalidInput);
  EXPECT_THROW(receive(not_a_number, SECOND), InvalidInput);
  EXPECT_EQ(viewers.size(), 0u);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
