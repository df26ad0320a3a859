// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/tree/growth/skeleton.h"

namespace vegetation_sim::forest {

/// A joint bends as requested up to the knee, then less and less, and never beyond the limit (E16)
/// [rad].
constexpr double BEND_KNEE = 0.6, BEND_LIMIT = 1.2;

/// Angle of the joint of a branch per wind: angle 1 = `first` . v, angle 2 = `second` . v [rad
/// s/m], where v is the air velocity at the base of the branch at rest (E3). `paper` joint: theta
/// and phi (equations 1 and 2). `swing` joint: bends about the rest x and y axes.
struct Response {
  Vec3 first{Vec3::Zero()}, second{Vec3::Zero()};
};

/// Deviation of a joint from rest [rad] (E6).
struct JointAngles {
  double first{0.0}, second{0.0};
};

/// Returns the drag per air speed of a branch with its own leaves, for the linear law F = c v
/// [kg/s]. c = rho Cd A v_ref / 2 with the density rho of the fluid, so that both laws have the
/// same force at the reference speed. Computed beside the masses, in branch_mass.cpp.
double dragPerSpeed(const Branch& branch, const Species& species);

/// Returns the bending stiffness of the joint of a branch: E pi r^4 / (4 l) [N m/rad]. Computed in
/// branch_mass.cpp too.
double jointStiffness(const Branch& branch, const Species& species);

/// Returns the responses of all branches. Gain `compliance`: the static deflection under the drag
/// of the whole sub-tree in uniform wind. Gain `paper`: L z / m with m = density * volume, times
/// PAPER_GAIN.
std::vector<Response> windResponse(const Skeleton& skeleton, const Species& species,
                                   const MotionLaw& law);

/// Scale of the printed 1/m [kg rad s/m^2]; equation 1 leaves it and the unit of its force open
/// (E13).
constexpr double PAPER_GAIN = 0.02;

/// Returns the velocity that enters the response: v, or v |v| / v_ref for quadratic drag.
Vec3 effectiveVelocity(const Vec3& velocity, Drag drag, double reference_speed);

/// Returns the bounded deviation for a response and an effective velocity, times the weight of the
/// level.
JointAngles deviation(const Response& response, const Vec3& velocity, double weight,
                      JointModel model);

/// Returns the rotation of a joint in the frame of its parent.
Quat jointRotation(const Branch& branch, const JointAngles& angles, JointModel model);

}  // namespace vegetation_sim::forest
