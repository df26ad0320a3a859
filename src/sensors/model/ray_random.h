// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::scan {

/// Keys of the random numbers of a sweep: different ones for each ray of each sweep of each sensor,
/// independent of order, thread and process.
struct NoiseKeys {
  std::uint64_t seed{0};
  std::uint64_t sweep{0};   ///< number of the tick, which follows from the stamp
  std::uint64_t sensor{0};  ///< 0: the cloud; 1: the planar scan
};

/// Random numbers of one ray and of its echoes, which are counted from 0.
class RayRandom {
 public:
  RayRandom(const NoiseKeys& keys, std::uint64_t ray)
      : random_(Random(keys.seed).child(keys.sensor).child(keys.sweep).child(ray)) {}

  /// Returns a normally distributed error of a range, relative to its standard deviation: mean 0,
  /// variance 1, as the sum of twelve uniform numbers (Irwin 1927, Hall 1927), never beyond 6.
  double unitNoise(int echo) const {
    double sum = -6.0;
    for (std::uint64_t i = 0; i < 3; ++i)  // four numbers of 16 bits each
      for (std::uint64_t bits = random_.bits(index(echo, i)), k = 0; k < 4; ++k, bits >>= 16)
        sum += (static_cast<double>(bits & 0xffff) + 0.5) / 65536.0;
    return sum;
  }
  /// Returns a uniform number in [0, 1) that decides whether an echo is detected.
  double detection(int echo) const { return random_.uniform(index(echo, 3)); }
  /// Returns a uniform number in [0, 1) that places the first raindrop.
  double drop() const { return random_.uniform(index(0, 4)); }

 private:
  static std::uint64_t index(int echo, std::uint64_t number) {
    return 8 * static_cast<std::uint64_t>(echo) + number;
  }
  Random random_;
};

}  // namespace vegetation_sim::scan
