// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "trees/work_precision.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace vegetation_sim::bench {

const Point& Explorer::at(int steps) {
  const auto known = points_.find(steps);
  if (known != points_.end()) return known->second;
  const Drive run = drive(engine_, reference_, steps, cap_);
  Point point;
  point.steps = steps;
  point.instants = static_cast<int>(run.motion.size());
  point.error =
      run.broken ? std::numeric_limits<double>::infinity() : relativeError(run.motion, reference_);
  per_step_ = run.seconds / (1.0 * steps * point.instants);
  return points_.emplace(steps, point).first->second;
}

bool Explorer::affordable(int steps, double part) const {
  return per_step_ * steps * static_cast<double>(reference_.motion.size()) <= part * cap_;
}

// A first-order method would have needed one third of the steps for three times the error.
bool Explorer::stalled(int steps) const {
  const double now = points_.at(steps).error;
  for (const auto& [fewer, point] : points_)
    if (3 * fewer <= steps && fewer >= 4 && std::isfinite(point.error))
      return now > 0.95 * point.error;
  return false;
}

// Interpolates between two runs, in logarithms, where the line meets the tolerance, because whole
// steps per interval are coarse where few suffice.
double Explorer::between(int low, int high, double tolerance) {
  const double slope = std::log(at(low).error / at(high).error) / std::log(1.0 * low / high);
  return high * std::exp(std::log(tolerance / at(high).error) / slope);
}

// Returns a third more steps. Where a run is expensive and the method has shown its order, returns
// as many as that requires.
int Explorer::next(int low, double tolerance) {
  const int third = low < 4 ? low + 1 : low + (low + 1) / 3;
  const auto here = points_.find(low);
  if (affordable(third, 0.05) || here == points_.begin()) return third;
  const Point &now = here->second, &before = std::prev(here)->second;
  if (!std::isfinite(now.error) || !std::isfinite(before.error)) return third;
  const double order =
      std::log(before.error / now.error) / std::log(1.0 * now.steps / before.steps);
  if (!(order > 0.5)) return third;
  const double factor = 1.1 * std::pow(now.error / tolerance, 1.0 / order);
  return std::max(third, static_cast<int>(std::ceil(std::min(factor, 8.0) * low)));
}

Answer Explorer::longestStep(double tolerance) {
  int low = 0, high = 1;  // low does not hold
  while (at(high).error > tolerance) {
    low = high;
    if (stalled(low)) return {Answer::Kind::NEVER, static_cast<double>(low)};
    // Unstable runs end early, so a step beyond the cap may still be tried.
    if (!affordable(low, std::isfinite(at(low).error) ? 1.0 : 4.0))
      return {Answer::Kind::AT_LEAST, static_cast<double>(low)};
    high = next(low, tolerance);
  }
  while (high - low > 1 && high > 1.05 * low) {
    if (!affordable(high, 0.2)) {
      if (std::isfinite(at(low).error))
        return {Answer::Kind::BETWEEN, between(low, high, tolerance)};
      return {Answer::Kind::AT_LEAST, static_cast<double>(low)};
    }
    const int middle = (low + high) / 2;
    (at(middle).error > tolerance ? low : high) = middle;
  }
  const bool line = low > 0 && std::isfinite(at(low).error);
  return {Answer::Kind::FOUND, line ? between(low, high, tolerance) : static_cast<double>(high)};
}

}  // namespace vegetation_sim::bench
