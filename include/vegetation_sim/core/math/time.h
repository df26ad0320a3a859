// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace vegetation_sim {

/// A stamp: nanoseconds since the epoch of ROS time. It is an integer, so that differences are
/// exact even for Unix times, where a float has lost the fraction of a second.
using Nanoseconds = std::int64_t;

constexpr Nanoseconds NANOSECONDS_PER_SECOND = 1000000000;

/// Rate of the steps of physical motion [Hz].
constexpr int PHYSICS_RATE = 240;

/// Returns the seconds from one stamp to another: an exact integer difference first, then double.
inline double secondsBetween(Nanoseconds from, Nanoseconds to) {
  return static_cast<double>(to - from) * 1e-9;
}

/// Returns the stamp nearest to a duration in seconds.
Nanoseconds fromSeconds(double seconds);

/// A regular grid of ticks: tick k happens at k / rate, never at an accumulated sum of steps.
class TickGrid {
 public:
  /// @param rate_hz ticks per second, 1 to 1 000 000. @throws std::invalid_argument beyond that.
  explicit TickGrid(int rate_hz);

  int rate() const { return rate_hz_; }
  /// Returns the last tick at or before `stamp`.
  std::int64_t tickAt(Nanoseconds stamp) const;
  /// Returns the first nanosecond of `tick`.
  Nanoseconds timeOf(std::int64_t tick) const;

 private:
  int rate_hz_;
};

}  // namespace vegetation_sim
