// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/lod/tier_allocation.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Remembers the tier of each item, by id, from one allocation to the next.
class TierHysteresis {
 public:
  /// Sets `held` and `resting` of each choice, wants the cheapest tier up to `finest` that holds
  /// the tolerance, allocates, and remembers the outcome. Items that are not among the choices are
  /// forgotten. Unknown ids start at tier 0 without rest, and so do all ids after a step back in
  /// time.
  /// @param choices have rising ids.
  TierAllocation allocateTiers(std::vector<TierChoice>& choices, int finest, double room,
                               double tolerance, Nanoseconds stamp);

 private:
  struct Held {
    std::uint32_t id{0};
    int tier{0};
    Nanoseconds since{0};
  };
  void recall(std::vector<TierChoice>& choices, Nanoseconds stamp) const;
  void keep(const std::vector<TierChoice>& choices, Nanoseconds stamp);

  Nanoseconds stamp_{0};
  std::vector<Held> held_;  // ids rise; items that rest no more on tier 0 are left out
};

}  // namespace vegetation_sim
