// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "vegetation_sim/wind/sampling/wind_samples.h"
#include "vegetation_sim/wind/sampling/wind_window.h"

namespace vegetation_sim::forest {

/// Computes the wind velocity at many points at once, in the widest instruction set of the
/// processor, with the same bits as wind::Instant::velocity and WindWindow::velocities. Keeps its
/// memory from call to call.
class WindSampler {
 public:
  void clear() { count_ = 0; }
  /// @param point in world coordinates [m].
  void add(const Vec3& point);
  std::size_t size() const { return count_; }
  /// Samples the wind at all points, which stay for the next call.
  void sample(const wind::Instant& wind);
  /// Samples the three instants of a window.
  void sample(const WindWindow& window);
  /// At point i, in a instant of the window that was sampled last, or of one instant, 0, world
  /// [m/s].
  Vec3 velocity(std::size_t i, std::size_t instant = 0) const {
    return {air_[instant].x[i], air_[instant].y[i], air_[instant].z[i]};
  }

 private:
  struct Rows {
    std::vector<double> x, y, z;  // padded to whole pairs of vectors
  };
  void sampleAt(std::size_t instant, const wind::Instant& wind);
  void addTerms(std::size_t instant, const wind::Instant& wind);
  wind::WindSamples rows(std::size_t instant);

  std::size_t count_{0};
  Rows points_;
  std::array<Rows, 3> air_;
};

}  // namespace vegetation_sim::forest
