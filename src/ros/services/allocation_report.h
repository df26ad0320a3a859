// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <string>
#include <vector>

#include "core/lod/tier_allocation.h"

namespace vegetation_sim {

/// What a governor had to go by, in words.
struct BalanceTerms {
  std::string what;                ///< it chose for: "Walkers"
  double tolerance{1.0};           ///< [pixel]
  std::string budget_name;         ///< parameter that may bind
  std::string unit;                ///< of budget and costs
  double budget{0.0};              ///< in that unit
  std::vector<std::string> tiers;  ///< names, coarsest first
};
/// Says on /diagnostics what was chosen and why.
void report(const TierAllocation& balance, const BalanceTerms& terms,
            diagnostic_updater::DiagnosticStatusWrapper& status);

}  // namespace vegetation_sim
