// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services/diagnostics.h"

#include <gtest/gtest.h>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {
namespace {

std::string publishedOf(int faults) {
  Faults all;
  for (int i = 1; i <= faults; ++i) all.add("fault " + std::to_string(i));
  diagnostic_updater::DiagnosticStatusWrapper status;
  status.summary(diagnostic_msgs::DiagnosticStatus::OK, "running");
  warnOfMore(status, 2, 1, all.text());
  return status.message;
}

// A message with a hundred wrong robots does not fill the screen.
TEST(Diagnostics, ReportTheFirstFaultsAndTheNumberOfOthers) {
  EXPECT_EQ(publishedOf(1), "1 fault 1");
  EXPECT_EQ(publishedOf(5), "1 fault 1\nfault 2\nfault 3\nfault 4\nfault 5");
  EXPECT_EQ(publishedOf(7), "1 fault 1\nfault 2\nfault 3\nfault 4\nfault 5\nand 2 more");
  EXPECT_EQ(publishedOf(100).substr(publishedOf(100).size() - 11), "and 95 more");
}

TEST(Diagnostics, ReportEachFaultOnce) {
  diagnostic_updater::DiagnosticStatusWrapper status;
  status.summary(diagnostic_msgs::DiagnosticStatus::OK, "running");
  warnOfMore(status, 3, 3, "ticks dropped");
  EXPECT_EQ(status.message, "running");
  EXPECT_EQ(status.level, diagnostic_msgs::DiagnosticStatus::OK);
}

TEST(Diagnostics, ReportRejectionsOnceWithTheLastReason) {
  Refusals refusals("forest_animator");
  refusals.add("wind", "speed = nan");
  refusals.add("viewer", "height = 0");
  diagnostic_updater::DiagnosticStatusWrapper status;
  refusals.warn(status);
  EXPECT_EQ(status.message, "2 refused input: viewer: height = 0");
  status.clearSummary();
  refusals.warn(status);
  EXPECT_EQ(status.message, "");
  EXPECT_EQ(refusals.count(), 2u);
}

// What other packages throw may have any length.
TEST(Diagnostics, ReportTheBeginningOfALongReason) {
  Refusals refusals("forest_animator");
  refusals.add("wind", std::string(1 << 20, 'x'));
  EXPECT_EQ(refusals.last().size(), LONGEST_ERROR + 3);
  diagnostic_updater::DiagnosticStatusWrapper status;
  refusals.warn(status);
  EXPECT_LT(status.message.size(), LONGEST_ERROR + 100);
  status.clearSummary();
  warnOfMore(status, 1, 0, std::string(1 << 20, 'x'));
  EXPECT_LT(status.message.size(), LONGEST_ERROR + 100);
}

}  // namespace
}  // namespace vegetation_sim
