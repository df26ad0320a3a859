// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/core/math/time.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace vegetation_sim {
namespace {

std::int64_t floorDivide(std::int64_t a, std::int64_t b) {
  const std::int64_t q = a / b;
  return (a % b != 0 && (a < 0) != (b < 0)) ? q - 1 : q;
}

}  // namespace

Nanoseconds fromSeconds(double seconds) {
  return static_cast<Nanoseconds>(std::nearbyint(seconds * 1e9));
}

TickGrid::TickGrid(int rate_hz) : rate_hz_(rate_hz) {
  if (rate_hz < 1 || rate_hz > 1000000)
    throw std::invalid_argument("tick rate = " + std::to_string(rate_hz) +
                                " Hz is outside 1 to 1000000");
}

std::int64_t TickGrid::tickAt(Nanoseconds stamp) const {
  const std::int64_t second = floorDivide(stamp, NANOSECONDS_PER_SECOND);
  const std::int64_t rest = stamp - second * NANOSECONDS_PER_SECOND;
  return second * rate_hz_ + rest * rate_hz_ / NANOSECONDS_PER_SECOND;
}

Nanoseconds TickGrid::timeOf(std::int64_t tick) const {
  const std::int64_t second = floorDivide(tick, rate_hz_);
  const std::int64_t rest = tick - second * rate_hz_;
  // Rounding up makes tickAt(timeOf(k)) == k.
  return second * NANOSECONDS_PER_SECOND +
         (rest * NANOSECONDS_PER_SECOND + rate_hz_ - 1) / rate_hz_;
}

}  // namespace vegetation_sim
