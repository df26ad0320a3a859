// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Chooses between two inputs of a sensor: what is near sensors, and the whole, which is received
/// only until the other has had all that was asked for during SETTLED.
class NearChoice {
 public:
  static constexpr double SETTLED = 1.0;  ///< [s]

  /// @param is_near whether the near input has all that is asked for.
  /// @param is_whole whether the whole one is up to date. @return whether to use the near one.
  bool choose(bool is_near, bool is_whole, Nanoseconds stamp) {
    is_complete_ = is_near || is_whole;
    if (!is_near || !uncovered_) uncovered_ = stamp;
    return is_near;
  }
  /// Whether the last choice had all that was asked for.
  bool isComplete() const { return is_complete_; }
  /// Whether the whole input is to be received.
  bool needsWhole(Nanoseconds stamp) const {
    return !uncovered_ || secondsBetween(*uncovered_, stamp) < SETTLED;
  }
  void reset() { *this = NearChoice(); }

 private:
  std::optional<Nanoseconds> uncovered_;  // the last stamp at which the near input lacked something
  bool is_complete_{true};
};

}  // namespace vegetation_sim
