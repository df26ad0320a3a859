// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "crowd/body/body_skeleton.h"

namespace vegetation_sim::crowd {

/// Largest differences of the numbers of a walker that was rounded.
struct WalkerRounding {
  double place{0.0};      ///< of the walker and its feet, along each axis [m]
  double ground{0.0};     ///< of the height of the ground at the walker [m]
  double velocity{0.0};   ///< along each axis [m/s]
  double heading{0.0};    ///< [rad]
  double gait{0.0};       ///< [cycles]
  double turn_rate{0.0};  ///< [rad/s]
  double height{0.0};     ///< of the body [m]
};

/// Returns how far the rounding moves the end of any limb at most [m]: each number moves it by its
/// own effect on the body of this walker, of first order, and the effects add up along each axis.
/// The body is drawn as displays do: all of it as high above the ground as its place.
double limbErrorOf(const Walker& walker, const terrain::HeightMap& terrain,
                   const MotionStyles& styles, double seconds, const WalkerRounding& rounding);

}  // namespace vegetation_sim::crowd
