// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "dynamics/contact/rounded_box.h"
#include "tree/physical/interaction.h"
#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim::forest {

using Bodies = std::map<std::string, Body>;  // by id

/// No edge, radius or length of a body is larger or smaller [m].
constexpr double LARGEST_BODY = 50.0, SMALLEST_BODY = 1e-3;
/// Faster bodies are refused [m/s], [rad/s].
constexpr double FASTEST_BODY = 100.0, FASTEST_SPIN = 100.0;

/// Adds a fault for whatever is wrong with a body.
void check(const Body& body, Faults& faults);

/// A body's shape in its own axes.
physics::RoundedBox shapeOf(const Body& body);

/// Where a body is at a time near its stamp: velocity and spin are constant.
Pose poseAt(const Body& body, Nanoseconds stamp);

/// Velocity of a point (world) of a body that is at `pose` [m/s].
Vec3 velocityAt(const Body& body, const Pose& pose, const Vec3& point);

/// Velocity and spin that carry a body from one pose to another in `seconds`.
void setMotion(Body& body, const Pose& from, const Pose& to, double seconds);

}  // namespace vegetation_sim::forest
