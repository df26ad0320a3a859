// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::physics {

/// All points within `radius` of a box. Zero half edges give a sphere, a third edge alone a capsule
/// along z, and a zero radius a box. It is convex, so its signed distance is a convex function.
struct RoundedBox {
  Vec3 half{Vec3::Zero()};  ///< [m]
  double radius{0.0};       ///< [m]

  /// Returns the radius of a ball about the origin that contains it [m].
  double reach() const { return length(half) + radius; }
  /// Returns the largest depth of a point below the surface [m].
  double thickness() const { return std::min(half.x(), std::min(half.y(), half.z())) + radius; }
};

/// Returns how far a box extends to one side (unit vector, in the axes of the box) [m].
double supportOf(const RoundedBox& box, const Vec3& side);

/// A tapered round bar: radius changes linearly from the first end to the other.
struct Bar {
  Vec3 base{Vec3::Zero()}, axis{Vec3::UnitZ()};  ///< `axis` is unit [m]
  double length{1.0};                            ///< [m]
  double base_radius{0.0}, tip_radius{0.0};      ///< [m]

  Vec3 at(double along) const { return base + along * axis; }
  double radiusAt(double along) const {
    return base_radius + (tip_radius - base_radius) * (along / length);
  }
};

/// The points where two surfaces are nearest, or overlap most.
struct Proximity {
  double along{0.0};           ///< position on the bar's axis [m]
  Vec3 normal{Vec3::UnitZ()};  ///< from box to bar, unit
  double gap{0.0};             ///< between the surfaces; negative: depth of overlap [m]
};

/// Returns the signed distance from the surface to a point; `normal` receives its gradient. In the
/// axes of the box.
double signedDistance(const RoundedBox& box, const Vec3& point, Vec3& normal);

/// Returns the nearest points of a bar and a rounded box, in the axes of the box.
Proximity nearest(const RoundedBox& box, const Bar& bar);

/// Does the same for a bar that is known to be on one side (unit vector, in the axes of the box): a
/// bar that overlaps deeply stays on that side, even beyond the box's axis.
Proximity nearest(const RoundedBox& box, const Bar& bar, const Vec3& side);

/// The first contact of a bar whose ends move at constant velocities relative to the box [m/s],
/// within `horizon` [s].
struct Meeting {
  bool met{false};
  double time{0.0};  ///< [s]
  Proximity there;
};
Meeting sweep(const RoundedBox& box, const Bar& bar, const Vec3& base_velocity,
              const Vec3& tip_velocity, double horizon);

}  // namespace vegetation_sim::physics
