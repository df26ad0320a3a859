// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services/allocation_report.h"

#include <algorithm>

namespace vegetation_sim {
namespace {

// Returns whether any object in view has a cost, an error or a tier above the lowest.
bool seesAny(const TierAllocation& balance) {
  return balance.wanted > 0.0 || balance.largest > 0.0 ||
         std::any_of(balance.counts.begin() + 1, balance.counts.end(),
                     [](std::size_t count) { return count > 0; });
}

std::string reasonOf(const TierAllocation& balance, const BalanceTerms& terms) {
  if (balance.held_back > 0 || balance.wanted > terms.budget) return terms.budget_name + " binds";
  if (balance.over > 0) return "there are no finer tiers";
  return seesAny(balance) ? "the tolerance is held" : "no viewer needs detail";
}

}  // namespace

void report(const TierAllocation& balance, const BalanceTerms& terms,
            diagnostic_updater::DiagnosticStatusWrapper& status) {
  status.summary(diagnostic_msgs::DiagnosticStatus::OK, reasonOf(balance, terms));
  const std::string in_unit = " [" + terms.unit + "]";
  status.add("Tolerance [pixel]", terms.tolerance);
  status.add("Largest predicted error [pixel]", balance.largest);
  status.add(terms.what + " above the tolerance", balance.over);
  status.add(terms.what + " that the budget holds back", balance.held_back);
  status.add("Cost" + in_unit, balance.cost);
  status.add("Cost that the tolerance asks for" + in_unit, balance.wanted);
  status.add("Budget" + in_unit, terms.budget);
  for (std::size_t tier = 0; tier < terms.tiers.size(); ++tier)
    status.add(terms.what + ": " + terms.tiers[tier], balance.counts[tier]);
}

PredictedError predictError(const std::string& topic, const TierAllocation& balance,
                            const BalanceTerms& terms) {
  PredictedError out;
  out.topic = topic;
  out.pixels = balance.largest;
  out.metres = balance.largest_metres;
  out.tolerance = terms.tolerance;
  out.over = static_cast<std::uint32_t>(balance.over);
  out.held_back = static_cast<std::uint32_t>(balance.held_back);
  out.cost = balance.cost;
  out.wanted = balance.wanted;
  out.budget = terms.budget;
  out.unit = terms.unit;
  return out;
}

}  // namespace vegetation_sim
