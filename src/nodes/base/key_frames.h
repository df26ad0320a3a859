// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/lod/tier_allocation.h"

namespace vegetation_sim {

/// When complete states come on a thin wire (N7): as often as asked for, or half, a quarter ... as
/// often, as their size lets them on a budget. What is off meanwhile is a replica that has lost a
/// message, for as long as the next one takes. A function of ticks and sizes, not of a clock.
class KeyFrames {
 public:
  /// @param period wanted [s]. @param rate ticks [Hz]. @param budget [B/s].
  KeyFrames(double period, int rate, int budget);

  /// True once after demand(), and at every tick that period() divides.
  bool isDue(std::int64_t tick);
  /// The next tick has one, whatever it costs.
  void demand() { demanded_ = true; }
  /// What the last one took; so will the next one.
  void sent(std::uint64_t bytes);

  double period() const;  ///< [s]
  /// Of the choice: costs are bytes a second, errors seconds.
  const TierAllocation& balance() const { return balance_; }
  double budget() const { return budget_; }

 private:
  std::int64_t ticks() const;

  int ticks_, rate_;  // a period as it is wanted, a second
  double budget_;
  int bisection_{0};  // of how often they come
  bool demanded_{true};
  TierAllocation balance_;
};

}  // namespace vegetation_sim
