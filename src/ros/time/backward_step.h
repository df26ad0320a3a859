// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// The one rule of nodes and displays for a clock that goes back. A step of time synchronisation,
/// or a second clock that is a little behind, is ridden out: what runs waits until the clock passes
/// the newest time again. A larger step is a jump back, after which nodes and displays start anew.
class BackwardStep {
 public:
  static constexpr Nanoseconds LARGEST_STEP = NANOSECONDS_PER_SECOND / 10;  ///< ridden out

  /// Returns whether the clock has jumped back to `now`, measured from the newest time since the
  /// jump before.
  bool jumpsBackTo(Nanoseconds now) {
    const bool jumped = newest_ - now > LARGEST_STEP;
    newest_ = jumped ? now : std::max(newest_, now);
    return jumped;
  }
  Nanoseconds newest() const { return newest_; }

 private:
  Nanoseconds newest_{0};
};

}  // namespace vegetation_sim
