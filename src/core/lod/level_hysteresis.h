// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/lod/level_allocation.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Rungs from one choice to the next, by id.
class HeldRungs {
 public:
  /// Tells each choice, wants the cheapest rung up to `finest` that holds the tolerance, governs,
  /// and takes over what was chosen; who is not among the choices is forgotten. A stranger holds
  /// nothing and does not rest; where time went back all are strangers.
  /// @param choices ids rising.
  Balance govern(std::vector<Choice>& choices, int finest, double room, double tolerance,
                 Nanoseconds stamp);

 private:
  struct Held {
    std::uint32_t id{0};
    int rung{0};
    Nanoseconds since{0};
  };
  void recall(std::vector<Choice>& choices, Nanoseconds stamp) const;
  void keep(const std::vector<Choice>& choices, Nanoseconds stamp);

  Nanoseconds stamp_{0};
  std::vector<Held> held_;  // ids rise; not of those that rest no more on rung 0
};

}  // namespace vegetation_sim
