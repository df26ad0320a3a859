// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Chooses between two inputs of a sensor: what is near sensors, and the whole, which is received
/// only until the other has had all that was asked for during SETTLED.
class NearChoice {
 public:
  static constexpr double SETTLED = 1.0;  ///< [s]

  /// @param covers whether the near input has all that is asked for, as of its stamp `near`.
  /// @param whole stamp of the other input.
  void choose(bool covers, Nanoseconds near, Nanoseconds whole, Nanoseconds stamp) {
    const bool has_all = covers && near >= whole, is_whole = near <= whole;
    is_near_ = has_all || !is_whole;
    is_complete_ = has_all || is_whole;
    if (!has_all || !uncovered_) uncovered_ = stamp;
  }
  /// Whether the near input was chosen.
  bool isNear() const { return is_near_; }
  /// Whether the chosen input had all that was asked for.
  bool isComplete() const { return is_complete_; }
  /// Whether the whole input is to be received.
  bool needsWhole(Nanoseconds stamp) const {
    return !uncovered_ || secondsBetween(*uncovered_, stamp) < SETTLED;
  }
  void reset() { *this = NearChoice(); }

 private:
  std::optional<Nanoseconds> uncovered_;  // the last stamp at which the near input lacked something
  bool is_near_{false}, is_complete_{true};
};

}  // namespace vegetation_sim
