// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sensors/geometry/box.h"
#include "sensors/geometry/ray.h"

namespace vegetation_sim::scan {

/// Tapered cylinder with a ball at each end: a branch, a person's limb, a piece of a blade.
struct Rod {
  Vec3 base{Vec3::Zero()};                                ///< [m]
  Vec3 axis{Vec3::UnitZ()};                               ///< unit, from base to tip
  double length{0.0}, base_radius{0.0}, tip_radius{0.0};  ///< [m]
};
Rod rodBetween(const Vec3& base, const Vec3& tip, double base_radius, double tip_radius);
Box boxOf(const Rod& rod);

/// Entry of a ray into a rod.
struct Meeting {
  double distance{0.0};  ///< [m]
  double cosine{0.0};    ///< cosine of the angle between ray and normal
};
/// Intersects a ray and a rod. @return false if there is no entry before `reach`, or the ray starts
/// inside.
bool meet(const Ray& ray, const Rod& rod, double reach, Meeting& out);

/// Interval of a ray, as distances along it [m]; empty if from >= to.
struct Stretch {
  double from{0.0}, to{0.0};
};
/// Returns the interval of a ray, from its origin on, within `radius` of the rod's axis.
Stretch within(const Ray& ray, const Rod& rod, double radius);

}  // namespace vegetation_sim::scan
