// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "vegetation_sim/canopy/plane/plane_field.h"
#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::canopy {

constexpr int SIDES = 4;             ///< right-, left-, up- and downward wind, in this order
constexpr int TURBULENCE_MODES = 4;  ///< eddies along a side
constexpr int AIR_NODES = 5;         ///< samples of the wind field along a side of the square

/// Wind that comes in at one side of the plane (S3-13).
struct SideWind {
  double strength{0.0};   ///< largest speed without turbulence; 0: no wind [m/s]
  double frequency{0.0};  ///< frequency of the swell; 0: steady [Hz]
};

struct SourceSettings {
  std::array<SideWind, SIDES> sides;
  double steadiness{0.4};       ///< share of the strength that is steady
  double turbulence{0.2};       ///< rms of the fluctuation / strength
  double turbulence_time{0.5};  ///< correlation time of the fluctuation [s]
  double fringe{0.06};          ///< width of the inflow band / width of the square
  double fringe_rate{10.0};     ///< rate at which air in the band takes up its wind [1/s]
  double law_gain{1.0};         ///< share of the wind field that reaches the plane; 0: sides only
  double follow_rate{1.0};  ///< rate at which air outside the bands takes up the wind field [1/s]
};
void describe(FieldVisitor& visitor, SourceSettings& settings);

/// Samples of the wind field on the plane at an instant: in-plane velocity [m/s] at AIR_NODES x
/// AIR_NODES points from corner to corner, row after row from the lowest, and its mean across the
/// plane.
struct PlaneAir {
  std::array<PlaneVector, static_cast<std::size_t>(AIR_NODES) * AIR_NODES> nodes{};
  double depth{0.0};  ///< mean along the plane's normal, towards its camera [m/s]
};

/// Fluctuations along the sides: Ornstein-Uhlenbeck amplitudes of cosines and sines.
using Turbulence = std::array<double, static_cast<std::size_t>(SIDES) * 2 * TURBULENCE_MODES>;

/// A time interval in seconds since the layout's epoch, and its number.
struct Interval {
  double from{0.0}, length{0.0};
  std::uint64_t number{0};
};

/// Adds wind to a flow by relaxation that is exact in time, so that no rate is too stiff.
class Sources {
 public:
  /// @param seed of the turbulence, whose random numbers are keyed by Interval::number.
  Sources(const SourceSettings& settings, int size, std::uint64_t seed);

  /// Advances the fluctuations to the end of a step.
  void carryOn(const Interval& interval, Turbulence& turbulence) const;
  /// Relaxes the flow in the bands, and everywhere if there is air.
  void apply(const Interval& interval, const PlaneAir* air, const Turbulence& turbulence,
             PlaneField& flow) const;
  /// Returns the mean swell of a side over an interval, without turbulence [m/s].
  double swell(int side, const Interval& interval) const;

 private:
  void applySide(int side, const Interval& interval, const Turbulence& turbulence,
                 PlaneField& flow) const;
  void applyAir(double length, const PlaneAir& air, PlaneField& flow) const;

  SourceSettings settings_;
  Random random_;
  std::vector<double> band_;  // share of the band's rate by distance from the edge [cells]
};

}  // namespace vegetation_sim::canopy
