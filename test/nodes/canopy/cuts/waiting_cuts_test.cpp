// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/canopy/waiting_cuts.h"

#include <gtest/gtest.h>

#include <string>

#include "vegetation_sim/canopy/plants/plant.h"
#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {
namespace {

CanopyEvent cutOf(std::size_t plants, double stamp) {
  CanopyEvent out;
  out.kind = CanopyEvent::CUT;
  out.header.stamp = ros::Time(stamp);
  out.cut_plants.resize(plants);
  return out;
}

TEST(WaitingCuts, AreBoundedInTheNumberOfTheirPlants) {
  EventQueue<CanopyEvent> inputs(false);
  std::size_t waiting = 0;
  for (; waiting + canopy::MOST_PLANTS <= MOST_WAITING_PLANTS; waiting += canopy::MOST_PLANTS) {
    EXPECT_NO_THROW(checkRoomToWait(inputs, canopy::MOST_PLANTS)) << waiting;
    ASSERT_TRUE(inputs.add(cutOf(canopy::MOST_PLANTS, 5.0)));
  }
  EXPECT_NO_THROW(checkRoomToWait(inputs, MOST_WAITING_PLANTS - waiting));
  try {
    checkRoomToWait(inputs, MOST_WAITING_PLANTS - waiting + 1);
    FAIL() << "one plant more may wait";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.code(), FaultCode::NO_ROOM);
    EXPECT_NE(std::string(error.what()).find("= 2000001 with the "), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("allowed are 0 to 2000000"), std::string::npos)
        << error.what();
  }
  inputs.take(5 * NANOSECONDS_PER_SECOND);
  EXPECT_NO_THROW(checkRoomToWait(inputs, canopy::MOST_PLANTS));
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
