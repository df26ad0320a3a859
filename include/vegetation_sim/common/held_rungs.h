// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "vegetation_sim/common/governor.h"
#include "vegetation_sim/common/time.h"

namespace vegetation_sim {

/// Rungs from one choice to the next, by id.
class HeldRungs {
 public:
  /// Tells a choice what it held; a stranger holds nothing.
  void recall(Choice& choice, Nanoseconds stamp) const;
  /// Takes over what was chosen, and forgets the others.
  void keep(const std::vector<Choice>& choices, Nanoseconds stamp);

 private:
  struct Held {
    int rung{0};
    Nanoseconds since{0};
  };
  std::map<std::uint32_t, Held> held_;
};

}  // namespace vegetation_sim
