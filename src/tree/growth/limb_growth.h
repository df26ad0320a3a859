// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "vegetation_sim/tree/growth/forest_layout.h"

namespace vegetation_sim::forest {

/// Numbers of a limb's generator, which are drawn from its key.
enum LimbDraw : std::uint64_t { LENGTH, PLACE, AZIMUTH, ANGLE, COUNT, LEAVES, LEAN, TREE };

/// A limb before it is divided into branches.
struct Limb {
  int bearer{-1};                            ///< index among the limbs one depth below
  int segment{0};                            ///< segment of the bearer
  double h{0.0};                             ///< position along that segment [m]
  double theta{0.0}, phi{0.0};               ///< of its first branch, see Branch [rad]
  double length{0.0};                        ///< [m]
  double base_radius{0.0}, tip_radius{0.0};  ///< [m]
  int leaves{0};                             ///< leaf clusters
  std::uint64_t key{0};                      ///< key of its random numbers
  std::uint64_t azimuth{0}, angle{0};        ///< its bits of AZIMUTH and ANGLE
};

/// Returns the radius [m] at the share f of a limb's length.
inline double radiusAt(const Limb& limb, double f) {
  return limb.base_radius + (limb.tip_radius - limb.base_radius) * f;
}

/// Returns the limbs of each depth, those of one depth grouped by bearer.
/// @param count receives the number of their branches.
std::vector<std::vector<Limb>> growLimbs(const TreeSeed& seed, const Species& species,
                                         std::size_t& count);

}  // namespace vegetation_sim::forest
