// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/contact/rounded_box.h"
#include "vegetation_sim/canopy/contact/fibres.h"

namespace vegetation_sim::canopy {

/// A body at the end of a step.
struct PosedBody {
  physics::RoundedBox shape;
  Pose pose;
  Vec3 velocity{Vec3::Zero()}, spin{Vec3::Zero()};  ///< world [m/s], [rad/s]
};

/// Impulse of the cells of a plant on a body, summed over steps.
struct BodyLoad {
  Vec3 impulse{Vec3::Zero()};   ///< [N s]
  Vec3 moment{Vec3::Zero()};    ///< about the origin of the body [N m s]
  Vec3 weighted{Vec3::Zero()};  ///< sum of points times weights
  double weight{0.0};           ///< sum of the magnitudes of impulses [N s]
  double volume{0.0};           ///< of the overlap, times the duration [m^3 s]
};

/// Steps over any time without bodies. The result is exact; below 2e-5 rad the cell rests.
void swing(const PushLaw& law, double dt, Cluster& cluster);

/// Takes one step of a cell among bodies by backward Euler, which is stable for any step, or
/// swings if it touches none. @param loads of the bodies, in their order.
void stepCluster(const PushLaw& law, const Fibres& fibres, std::size_t cell, double dt,
                 const std::vector<PosedBody>& bodies, Cluster& cluster,
                 std::vector<BodyLoad>& loads);

/// Returns the kinetic and elastic energy of a cell [J].
double energyOf(const PushLaw& law, const Fibres& fibres, std::size_t cell, const Cluster& cluster);

}  // namespace vegetation_sim::canopy
