// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "vegetation_sim/wind/instant.h"

namespace vegetation_sim::wind {

/// Turbulence of a breeze: 24 Fourier modes that the mean wind carries along (Taylor's hypothesis),
/// with von Karman's along-wind spectrum between 0.01 and 2 Hz. docs/wind.md derives it.
class Breeze {
 public:
  static constexpr int MODES = 24;
  static constexpr double LOWEST_HZ = 0.01, HIGHEST_HZ = 2.0;
  /// Ratio of the rms of the lateral and of the vertical fluctuation to that along the wind.
  static constexpr double LATERAL = 0.8, VERTICAL = 0.5;
  /// Davenport's decay: the coherence at distance r across the wind is exp(-DECAY f r / U).
  static constexpr double DECAY = 10.0;
  static constexpr double LEAST_CARRIER = 0.5;  ///< [m/s] speed at which modes travel in a calm

  struct Wave {
    Mode at_epoch;
    double frequency;  ///< [Hz]
  };

  /// Creates still air.
  Breeze() = default;
  /// Random numbers are keyed by seed and name, so an edit of a source keeps the phases of its
  /// gusts.
  Breeze(const Primitive& primitive, std::uint64_t seed);

  /// Adds the modes at `elapsed` [s] after the epoch, scaled by `weight`.
  void addModes(double elapsed, double weight, std::vector<Mode>& modes) const;
  const std::vector<Wave>& waves() const { return waves_; }

 private:
  std::vector<Wave> waves_;
};

/// Returns von Karman's one-sided density [(m/s)^2/Hz] at f [Hz] of the along-wind fluctuation, not
/// limited to a band: its integral from 0 to infinity is sigma^2.
double vonKarmanDensity(double f, double sigma, double length_scale, double speed);

}  // namespace vegetation_sim::wind
