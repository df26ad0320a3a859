// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/lod/tier_allocation.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// TreeModels from one choice to the next, by id.
class TierHysteresis {
 public:
  /// Tells each choice, wants the cheapest tier up to `finest` that holds the tolerance, governs,
  /// and takes over what was chosen; who is not among the choices is forgotten. A stranger holds
  /// nothing and does not rest; where time went back all are strangers.
  /// @param choices ids rising.
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
  std::vector<Held> held_;  // ids rise; not of those that rest no more on tier 0
};

}  // namespace vegetation_sim
