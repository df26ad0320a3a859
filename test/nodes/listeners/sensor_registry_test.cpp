// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/listeners/sensor_registry.h"

#include <gtest/gtest.h>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {
namespace {

constexpr Nanoseconds SECOND = NANOSECONDS_PER_SECOND;

SensorInterest sensor(const std::string& id, double x) {
  SensorInterest out;
  out.id = id;
  out.header.frame_id = "map";
  out.position.x = x;
  out.range = 30.0;
  out.tolerance = 0.01;
  return out;
}

struct SensorRegistryTest : testing::Test {
  void receive(const SensorInterest& message, Nanoseconds stamp) {
    sensors.hear(message, buffer, "map", stamp);
  }
  tf2_ros::Buffer buffer{ros::Duration(10.0), false};
  SensorRegistry sensors;
};

TEST_F(SensorRegistryTest, TheNewestPlaceCountsUntilTheSensorIsSilent) {
  receive(sensor("lidar", 1.0), 9 * SECOND);
  receive(sensor("lidar", 5.0), 10 * SECOND);
  const InterestArea expected{5.0, 0.0, 30.0 + SensorRegistry::REACH};
  EXPECT_EQ(sensors.discsAt(13 * SECOND), std::vector<InterestArea>{expected});
  EXPECT_TRUE(sensors.discsAt(13 * SECOND + 1).empty());
}

TEST_F(SensorRegistryTest, InvalidSensorsAndThoseAboveTheLimitAreRejected) {
  SensorInterest bad = sensor("bad", 0.0);
  bad.range = 2000.0;
  EXPECT_THROW(receive(bad, SECOND), InvalidInput);
  bad = sensor("bad", 0.0);
  bad.header.frame_id = "unknown";
  EXPECT_THROW(receive(bad, SECOND), InvalidInput);
  for (std::size_t i = 0; i < SensorRegistry::MOST; ++i)
    receive(sensor(std::to_string(i), 0.0), SECOND);
  EXPECT_THROW(receive(sensor("late", 0.0), SECOND), InvalidInput);
  receive(sensor("7", 2.0), SECOND);
  EXPECT_EQ(sensors.size(), SensorRegistry::MOST);
}

TEST(DiscsOfViewersTest, ViewersWithoutALimitSeeAll) {
  Viewpoint eye;
  eye.position = Vec3(3.0, 4.0, 50.0);
  EXPECT_EQ(discsOf({eye}, 100.0), (std::vector<InterestArea>{{3.0, 4.0, 100.0}}));
  EXPECT_GT(discsOf({eye}, 0.0).front().radius, 1e8);
  EXPECT_TRUE(discsOf({}, 100.0).empty());
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
