// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "trees/engine.h"

namespace vegetation_sim::bench {

/// Error of one engine at one step.
struct Point {
  int steps{0};       ///< per interval
  double error{0.0};  ///< infinite: unstable
  int instants{0};    ///< instants that were compared; fewer than INTERVALS where time ran out
};

/// The longest step that holds a tolerance.
struct Answer {
  enum class Kind : int {
    FOUND = 0,     ///< bisected, and interpolated between the last two runs
    BETWEEN = 1,   ///< interpolated between two runs that are too expensive to refine
    AT_LEAST = 2,  ///< no run within the time cap holds it: fewer steps do not
    NEVER = 3      ///< shorter steps change nothing: the model differs
  };
  Kind kind{Kind::FOUND};
  double steps{0.0};  ///< per interval
};

/// Runs an engine against its reference and remembers the points.
class Explorer {
 public:
  /// No run may take more than `cap` seconds of processor time.
  Explorer(Engine& engine, const Reference& reference, double cap)
      : engine_(engine), reference_(reference), cap_(cap) {}

  /// Shortens the step until `tolerance` holds, then bisects.
  Answer longestStep(double tolerance);
  const std::map<int, Point>& points() const { return points_; }

 private:
  const Point& at(int steps);
  bool stalled(int steps) const;
  bool affordable(int steps, double part) const;
  double between(int low, int high, double tolerance);
  int next(int low, double tolerance);

  Engine& engine_;
  const Reference& reference_;
  double cap_, per_step_{0.0};
  std::map<int, Point> points_;
};

}  // namespace vegetation_sim::bench
