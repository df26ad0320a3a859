// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/contact/contact_stepper.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim::forest {

/// Decides which substeps of one step of a tree are repeated in two halves, so that the forces on a
/// branch change by at most MAX_FORCE_CHANGE of the law's limit in a substep.
class SubstepBisection {
 public:
  static constexpr double MAX_FORCE_CHANGE = 0.25;
  static constexpr Nanoseconds MIN_DURATION = 4000;  ///< of a substep
  static constexpr int MAX_COUNT = 128;              ///< bisections in a step

  /// Returns true if the last step of `stepper`, of this duration, was too coarse and may be
  /// bisected.
  bool bisect(const physics::ContactStepper& stepper, const physics::ContactLaw& law,
              Nanoseconds duration) {
    const bool coarse =
        stepper.forceChange() > MAX_FORCE_CHANGE * law.force_limit || !stepper.agreed();
    return coarse && duration >= 2 * MIN_DURATION && ++requested_ <= MAX_COUNT;
  }
  bool ranOut() const { return requested_ > MAX_COUNT; }

 private:
  int requested_{0};
};

}  // namespace vegetation_sim::forest
