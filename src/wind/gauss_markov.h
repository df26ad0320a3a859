// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "vegetation_sim/core/math/random.h"
#include "vegetation_sim/wind/primitive.h"

namespace vegetation_sim::wind {

/// A stationary Gauss-Markov (Ornstein-Uhlenbeck) process of variance 1, whose autocorrelation is
/// exp(-|t| / T), as a pure function of time. Samples at T / 32 are exact; a cubic B-spline through
/// them as control points is twice differentiable. docs/wind.md derives it.
class GaussMarkovProcess {
 public:
  static constexpr int HALVINGS = 10;   ///< of a cell of independent ends
  static constexpr int PER_SCALE = 32;  ///< samples in one time scale
  static constexpr double MOST = 1e15;  ///< largest |time| [scales]

  explicit GaussMarkovProcess(const Random& random) : random_(random) {}

  /// Returns the value at sample `index`, the time index / PER_SCALE.
  double sample(std::int64_t index) const;
  /// Returns the smoothed value at a time [scales], scaled to variance 1 in the mean of all times.
  double at(double time) const;

 private:
  double normal(std::uint64_t cell, std::uint64_t node) const;
  Random random_;
};

/// The fluctuation of a Gauss-Markov wind: independent processes along, across and upwards.
class GaussMarkov {
 public:
  /// Creates still air.
  GaussMarkov() = default;
  /// Random numbers are keyed by seed and name, as those of a breeze.
  GaussMarkov(const Primitive& primitive, std::uint64_t seed);

  /// Returns the fluctuation at `elapsed` [s] after the epoch [m/s].
  Vec3 at(double elapsed) const;
  /// Returns the root of the summed variance of all three directions [m/s].
  double rms() const { return rms_; }

 private:
  std::array<Vec3, 3> axes_{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  // times their rms [m/s]
  double rms_{0.0}, time_scale_{1.0};
  Random random_{0};
};

/// Returns the one-sided density [(m/s)^2/Hz] at f [Hz] of a Gauss-Markov process: its integral
/// from 0 to infinity is sigma^2.
double lorentzianDensity(double f, double sigma, double time_scale);

}  // namespace vegetation_sim::wind
