// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sensors/geometry/box.h"
#include "sensors/geometry/rod.h"

namespace vegetation_sim::scan {

/// Flat quadrilateral without thickness, seen from both sides: a leaf, a piece of a ribbon or a
/// face of a mesh. Its corners are root -+ low and tip -+ high.
struct Strip {
  Vec3 root{Vec3::Zero()}, tip{Vec3::Zero()};  ///< [m]
  Vec3 low{Vec3::Zero()}, high{Vec3::Zero()};  ///< half of the width at root and tip [m]
};
Box boxOf(const Strip& strip);
/// Intersects a ray with the two triangles of a strip. @return false if there is no hit before
/// `reach`.
bool meet(const Ray& ray, const Strip& strip, double reach, Meeting& out);

}  // namespace vegetation_sim::scan
