// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services/missing_inputs.h"

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace vegetation_sim {
namespace {

std::string warningOf(MissingInputs& missing) {
  diagnostic_updater::DiagnosticStatusWrapper status;
  status.summary(diagnostic_msgs::DiagnosticStatus::OK, "running");
  missing.warn("grass_field", status);
  return status.level == diagnostic_msgs::DiagnosticStatus::WARN ? status.message : "";
}

TEST(MissingInputs, AreAWarningThatNamesEachOnce) {
  MissingInputs missing;
  EXPECT_EQ(warningOf(missing), "");
  missing.add(describeMissingTransform("wheel", "map"));
  missing.add("no odometry on 'odom'");
  missing.add(describeMissingTransform("wheel", "map"));
  EXPECT_EQ(missing.size(), 2u);
  EXPECT_EQ(warningOf(missing), "no transform from 'wheel' to 'map'; no odometry on 'odom'");
  missing.clear();
  EXPECT_EQ(warningOf(missing), "");
}

TEST(MissingInputs, AreOneLineOnTheConsoleOnceTheyLast) {
  MissingInputs missing;
  missing.add("no odometry on 'odom'");
  std::vector<bool> logged;
  for (int warning = 0; warning < 5; ++warning) {
    testing::internal::CaptureStderr();
    warningOf(missing);
    logged.push_back(testing::internal::GetCapturedStderr().find("odom") != std::string::npos);
  }
  EXPECT_EQ(logged, (std::vector<bool>{false, false, true, false, false}));
}

TEST(MissingInputs, NameAtMostFive) {
  MissingInputs missing;
  for (int i = 0; i < 7; ++i) missing.add("no " + std::to_string(i));
  EXPECT_EQ(warningOf(missing), "no 0; no 1; no 2; no 3; no 4; and 2 more");
}

}  // namespace
}  // namespace vegetation_sim
