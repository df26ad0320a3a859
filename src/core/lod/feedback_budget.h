// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vegetation_sim {

/// Share of a budget that keeps a measured time near its target (N7). Only pictures may depend on
/// it: measured times differ from machine to machine.
class FeedbackBudget {
 public:
  static constexpr double LEAST = 0.04;  ///< share

  /// Takes a measured time. Returns the share, which falls while the mean of the last ten exceeds
  /// the target, and rises again, more slowly, while it is well below. @param measured, target [s];
  /// a target of 0 gives the whole budget.
  double update(double measured, double target);
  double share() const { return share_; }

 private:
  double share_{1.0}, mean_{0.0};
  int wait_{0};
};

}  // namespace vegetation_sim
