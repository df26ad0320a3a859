// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::wind {

/// Variable wind at one place by frequency: squares of its peak speed [m^2/s^2] on a grid of
/// frequencies and of slownesses, the time that a wave takes for a metre (0: all wind in phase).
struct GustSpectrum {
  static constexpr std::array<double, 12> FREQUENCIES{0.05, 0.07, 0.1,  0.145, 0.21, 0.3, 0.43,
                                                      0.62, 0.88, 1.26, 1.8,   2.6};  ///< [Hz]
  static constexpr std::array<double, 3> SLOWNESSES{0.0, 0.2, 0.8};                   ///< [s/m]

  /// [slowness][frequency]
  std::array<std::array<double, FREQUENCIES.size()>, SLOWNESSES.size()> power{};
  /// Largest expected speed, the steady part included [m/s]. Sources seldom peak together.
  double peak{0.0};

  /// Adds a square to the four grid points around it. A frequency below the lowest one counts with
  /// the square of the ratio, because plants follow slow wind so much better.
  void add(double frequency, double slowness, double square);
};

/// The variable parts of a wind at one stamp.
class GustSpectrumField {
 public:
  /// Ratio of peak to rms of a breeze within some ten seconds.
  static constexpr double PEAK = 2.5;

  GustSpectrumField() = default;
  GustSpectrumField(const Field& field, Nanoseconds stamp);

  /// Returns the spectrum that any point within `reach` [m] (horizontally) of `position` meets over
  /// a cycle of the primitives.
  GustSpectrum at(const Vec3& position, double reach) const { return atOf(position, reach, true); }
  /// Returns the same without disks.
  GustSpectrum withoutDisks(const Vec3& position, double reach) const {
    return atOf(position, reach, false);
  }
  bool hasDisks() const { return has_disks_; }

 private:
  struct Part {
    Term term;
    double frequency;
    double share;  // share of its bound that oscillates
    double onset;  // frequency at which half of it starts or ends; 0: it does neither
    bool disk;     // of paper 1
  };
  void addBreeze(const Primitive& p, double weight, const Breeze& breeze);
  void addGaussMarkov(const Primitive& p, double weight, Term term);
  GustSpectrum atOf(const Vec3& position, double reach, bool disks) const;

  GustSpectrum breezes_;
  double turbulence_{0.0};  // square of the breezes' peak
  Vec3 mean_{Vec3::Zero()};
  std::vector<Part> parts_;
  bool has_disks_{false};
};

}  // namespace vegetation_sim::wind
