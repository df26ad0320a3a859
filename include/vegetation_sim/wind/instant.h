// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/core/math/vectors.h"
#include "vegetation_sim/wind/primitive.h"

namespace vegetation_sim::wind {

/// A bounded primitive at one instant.
struct Term {
  Kind kind{Kind::DISK};
  Vec3 centre{Vec3::Zero()};  ///< [m]
  double radius{1.0};         ///< [m]
  bool smooth{true};          ///< envelope: smootherStep of (r-d)/r, else (r-d)/r
  /// Velocity in the middle of a disk, gust or wake, fade and sine included [m/s]. Unused by
  /// tornado and blast.
  Vec3 amplitude{Vec3::Zero()};
  /// gust, wake: horizontal unit vector along which the front or body moves
  Vec3 direction{Vec3::UnitX()};
  double rise{1.0}, plateau{0.0}, decay{1.0};  ///< gust, wake (without rise): lengths [m]
  // A bound covers these changes within one second:
  double travel{0.0};  ///< gust, wake: way of the centre along `direction`, to both sides [m]
  double sway{0.0};    ///< wake: way of the centre beside it [m]
  double turn{0.0};    ///< wake: sine of the turn of the direction; 1: any direction
  double limit{0.0};   ///< wake: largest speed [m/s]
  double core{1.0};    ///< tornado, blast: radius of the peak [m]
  double speed{0.0};   ///< tornado, blast: peak, fade included [m/s]
  double inflow{0.0}, updraft{0.0};  ///< tornado: fractions
  double peak{0.0};  ///< largest speed that the term reaches over its cycle, fade included [m/s]
};

/// One Fourier mode of the breeze: amplitude * cos(2 pi (wave . x + phase)).
struct Mode {
  Vec3 wave{Vec3::Zero()};       ///< [turns/m]
  double phase{0.0};             ///< in [0, 1) [turns]
  Vec3 amplitude{Vec3::Zero()};  ///< [m/s]
};

/// A wind field at one stamp, with all phases reduced in double precision.
struct Instant {
  Vec3 mean{Vec3::Zero()};  ///< sum of the means of the breezes [m/s]
  int breezes{0};           ///< number of breezes that blow
  std::vector<Mode> modes;
  std::vector<Term> terms;

  /// Returns the wind velocity at a position [m/s], world. The reference for every faster path.
  Vec3 velocity(const Vec3& position) const;
  /// Returns the same field with positions relative to `origin` [m], for kernels in single
  /// precision.
  Instant relativeTo(const Vec3& origin) const;
  /// Returns a bound on the speed that any point within `reach` [m] (horizontally) of `position`
  /// meets over a cycle of the primitives, the sum of those that reach it. Levels of detail depend
  /// on it, so it ignores momentary zeros of a sine, and each further wind makes them finer
  /// (S1-40).
  double speedBound(const Vec3& position, double reach) const {
    return speedBound(position, reach, steadyBound());
  }
  /// The part of speedBound() that is the same everywhere [m/s], and speedBound() with it, for many
  /// positions.
  double steadyBound() const;
  double speedBound(const Vec3& position, double reach, double steady) const;
};

}  // namespace vegetation_sim::wind
