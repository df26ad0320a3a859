// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/lod/tier_allocation.h"

namespace vegetation_sim {

/// Chooses the ticks at which complete states are published (N7). The period is the wanted one, or
/// the smallest power of two times it whose data rate fits the budget. A replica that has lost a
/// message is wrong until the next complete state. The choice depends on ticks and sizes only.
class KeyFrames {
 public:
  /// @param period wanted [s]. @param rate ticks [Hz]. @param budget [B/s].
  KeyFrames(double period, int rate, int budget);

  /// Returns true once after demand(), and at every tick that is a multiple of period().
  bool isDue(std::int64_t tick);
  /// Requests a complete state at the next tick, whatever the budget.
  void demand() { demanded_ = true; }
  /// Sets the size of the last complete state, which predicts the size of the next.
  void sent(std::uint64_t bytes);

  double period() const;  ///< [s]
  /// Returns the last choice; costs are in B/s, errors in seconds.
  const TierAllocation& balance() const { return balance_; }
  double budget() const { return budget_; }

 private:
  std::int64_t ticks() const;

  int ticks_, rate_;  // ticks of the wanted period, ticks per second
  double budget_;
  int bisection_{0};  // number of times the period is doubled
  bool demanded_{true};
  TierAllocation balance_;
};

}  // namespace vegetation_sim
