// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/tree/growth/skeleton.h"

namespace vegetation_sim::forest {

/// Density of air [kg/m^3].
constexpr double AIR_DENSITY = 1.225;
/// A joint bends as asked up to the knee, then ever less, never past the limit (E16) [rad].
constexpr double BEND_KNEE = 0.6, BEND_LIMIT = 1.2;

/// How far the joint of a branch turns per wind: angle 1 = `first` . v, angle 2 = `second` . v
/// [rad s/m], v the air velocity at the base of the branch at rest (E3).
/// `paper` joint: theta and phi (equations 1 and 2). `swing`: bends about the rest x and y axes.
struct Response {
  Vec3 first{Vec3::Zero()}, second{Vec3::Zero()};
};

/// Deviation of a joint from rest [rad] (E6).
struct JointAngles {
  double first{0.0}, second{0.0};
};

/// Drag per air speed of a branch with its own leaves, linear law F = c v [kg/s].
/// c = rho Cd A v_ref / 2, so that at the reference speed the force is the quadratic law's.
double dragPerSpeed(const Branch& branch, const Species& species);

/// Bending stiffness of the joint of a branch: E pi r^4 / (4 l) [N m/rad].
double jointStiffness(const Branch& branch, const Species& species);

/// Responses of all branches. Gain `compliance`: the static deflection under the drag of the whole
/// sub-tree in uniform wind. Gain `paper`: L z / m with m = density * volume, times PAPER_GAIN.
std::vector<Response> windResponse(const Skeleton& skeleton, const Species& species,
                                   const MotionLaw& law);

/// Scale of the printed 1/m [kg rad s/m^2]: equation 1 swallows it with the unit of its force
/// (E13).
constexpr double PAPER_GAIN = 0.02;

/// Velocity that enters the response: v, or v |v| / v_ref for quadratic drag.
Vec3 effectiveVelocity(const Vec3& velocity, Drag drag, double reference_speed);

/// Bounded deviation for a response and an effective velocity, times the level's weight.
JointAngles deviation(const Response& response, const Vec3& velocity, double weight,
                      JointModel model);

/// Rotation of a joint in its parent's frame.
Quat jointRotation(const Branch& branch, const JointAngles& angles, JointModel model);

}  // namespace vegetation_sim::forest
