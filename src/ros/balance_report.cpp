// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/ros/balance_report.h"

namespace vegetation_sim {

void tell(const Balance& balance, const BalanceTerms& terms,
          diagnostic_updater::DiagnosticStatusWrapper& status) {
  std::string why = "the tolerance is held";
  if (balance.over > 0) why = "finer rungs there are none";
  if (balance.held_back > 0) why = terms.budget_name + " binds";
  if (balance.cost <= 0.0) why = "nothing is seen";
  status.summary(diagnostic_msgs::DiagnosticStatus::OK, why);
  const std::string in_unit = " [" + terms.unit + "]";
  status.add("Tolerance [pixel]", terms.tolerance);
  status.add("Largest predicted error [pixel]", balance.largest);
  status.add(terms.what + " above the tolerance", balance.over);
  status.add(terms.what + " that the budget holds back", balance.held_back);
  status.add("Cost" + in_unit, balance.cost);
  status.add("Cost that the tolerance asks for" + in_unit, balance.wanted);
  status.add("Budget" + in_unit, terms.budget);
  for (std::size_t rung = 0; rung < terms.rungs.size(); ++rung)
    status.add(terms.what + ": " + terms.rungs[rung], balance.counts[rung]);
}

}  // namespace vegetation_sim
