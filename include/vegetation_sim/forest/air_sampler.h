// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/wind/instant.h"

namespace vegetation_sim::forest {

/// Air velocity at many points at once, in the widest instruction set of the processor: to the bit
/// what wind::Instant::velocity gives one by one. Keeps its memory from call to call.
class AirSampler {
 public:
  void clear() { count_ = 0; }
  /// @param point world [m].
  void add(const Vec3& point);
  std::size_t size() const { return count_; }
  /// Looks at all points; they stay for the next look.
  void sample(const wind::Instant& wind);
  /// At point i in the last look, world [m/s].
  Vec3 velocity(std::size_t i) const { return {vx_[i], vy_[i], vz_[i]}; }

 private:
  std::size_t count_{0};
  std::vector<double> x_, y_, z_, vx_, vy_, vz_;  // whole pairs of vectors
};

}  // namespace vegetation_sim::forest
