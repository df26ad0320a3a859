// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <vegetation_sim/PredictedError.h>

#include <string>
#include <vector>

#include "core/lod/tier_allocation.h"

namespace vegetation_sim {

/// Names and limits of an allocation, for its report.
struct BalanceTerms {
  std::string what;                ///< kind of objects: "Walkers"
  double tolerance{1.0};           ///< [pixel]
  std::string budget_name;         ///< parameter that may bind
  std::string unit;                ///< of budget and costs
  double budget{0.0};              ///< in that unit
  std::vector<std::string> tiers;  ///< names, coarsest first
};
/// Reports on /diagnostics the choice and its reason.
void report(const TierAllocation& balance, const BalanceTerms& terms,
            diagnostic_updater::DiagnosticStatusWrapper& status);
/// Returns the errors and costs of an allocation (N9). @param topic that is sent.
PredictedError predictError(const std::string& topic, const TierAllocation& balance,
                            const BalanceTerms& terms);

}  // namespace vegetation_sim
