// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/archive/archive.h"
#include "dynamics/contact/rounded_box.h"
#include "tree/physical/interaction.h"
#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/core/math/hash.h"

namespace vegetation_sim::forest {

/// Limits of edges, radii and lengths of a body [m].
constexpr double LARGEST_BODY = 50.0, SMALLEST_BODY = 1e-3;
/// Limits of velocity [m/s] and angular velocity [rad/s].
constexpr double FASTEST_BODY = 100.0, FASTEST_SPIN = 100.0;

/// Adds a fault for each invalid value of a body.
void check(const Body& body, Faults& faults);

/// Writes or reads a body, whose numbers check() has to check.
void archiveBody(Archive& a, Body& body);
/// Adds what the motion of a body and of what it touches depends on.
void addTo(Hash& hash, const Body& body);

/// Returns the shape of a body in its own axes.
physics::RoundedBox shapeOf(const Body& body);

/// Returns the pose of a body at a time near its stamp, with constant velocities.
Pose poseAt(const Body& body, Nanoseconds stamp);

/// Returns the velocity of a point (world) of a body at `pose` [m/s].
Vec3 velocityAt(const Body& body, const Pose& pose, const Vec3& point);

/// Sets the velocities that carry a body from one pose to another in `seconds`.
void setMotion(Body& body, const Pose& from, const Pose& to, double seconds);

}  // namespace vegetation_sim::forest
