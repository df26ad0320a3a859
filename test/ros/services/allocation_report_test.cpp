// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services/allocation_report.h"

#include <gtest/gtest.h>

#include <map>

namespace vegetation_sim {
namespace {

BalanceTerms terms() {
  return {"Walkers", 1.5, "marker_points", "points", 100.0, {"not drawn", "coarse", "fine"}};
}

std::string reasonFor(const TierAllocation& balance) {
  diagnostic_updater::DiagnosticStatusWrapper status;
  report(balance, terms(), status);
  EXPECT_EQ(status.level, diagnostic_msgs::DiagnosticStatus::OK);
  return status.message;
}

TierAllocation balanceOf(double cost, double wanted, double largest, std::size_t over,
                         std::size_t held, std::size_t fine) {
  TierAllocation out;
  out.cost = cost;
  out.wanted = wanted;
  out.largest = largest;
  out.over = over;
  out.held_back = held;
  out.counts[2] = fine;
  return out;
}

// N7: the reported reason is correct.
TEST(BalanceReport, GivesTheReason) {
  EXPECT_EQ(reasonFor(balanceOf(60, 60, 1, 0, 0, 2)), "the tolerance is held");
  EXPECT_EQ(reasonFor(balanceOf(60, 60, 3, 1, 0, 2)), "there are no finer tiers");
  EXPECT_EQ(reasonFor(balanceOf(90, 120, 3, 2, 2, 2)), "marker_points binds");
  EXPECT_EQ(reasonFor(TierAllocation()), "no viewer needs detail");
}

TEST(BalanceReport, ABudgetThatIsTooSmallForAnythingBinds) {
  EXPECT_EQ(reasonFor(balanceOf(0, 120, 3, 2, 2, 0)), "marker_points binds");
}

// The number of blades is reduced within their tier: no upgrade is held back, but the demand
// exceeds the budget.
TEST(BalanceReport, ABudgetThatThinsATierBinds) {
  EXPECT_EQ(reasonFor(balanceOf(99, 120, 1, 0, 0, 2)), "marker_points binds");
}

// Strips cost nothing, and objects that are small enough need no cost at all.
TEST(BalanceReport, ObjectsWithoutCostAreVisible) {
  EXPECT_EQ(reasonFor(balanceOf(0, 0, 0, 0, 0, 2)), "the tolerance is held");
  EXPECT_EQ(reasonFor(balanceOf(0, 0, 0.5, 0, 0, 0)), "the tolerance is held");
}

TEST(BalanceReport, NamesItsUnits) {
  diagnostic_updater::DiagnosticStatusWrapper status;
  report(balanceOf(90, 120, 3, 2, 1, 4), terms(), status);
  std::map<std::string, std::string> values;
  for (const auto& pair : status.values) values[pair.key] = pair.value;
  const std::map<std::string, std::string> expected{
      {"Tolerance [pixel]", "1.5"},
      {"Largest predicted error [pixel]", "3"},
      {"Walkers above the tolerance", "2"},
      {"Walkers that the budget holds back", "1"},
      {"Cost [points]", "90"},
      {"Cost that the tolerance asks for [points]", "120"},
      {"Budget [points]", "100"},
      {"Walkers: not drawn", "0"},
      {"Walkers: coarse", "0"},
      {"Walkers: fine", "4"}};
  EXPECT_EQ(values, expected);
}

}  // namespace
}  // namespace vegetation_sim
