// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "reference/canopy/printed_view.h"

#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::canopy {

Vec3 printedToView(const PlaneVector& in_plane, double tilt, double alpha, double beta) {
  const SinCos t = sinCos(tilt), a = sinCos(alpha), b = sinCos(beta);
  const Vec3 world(in_plane.u, in_plane.v * t.sin, in_plane.v * t.cos);
  const Vec3 turned(world.x() * a.cos + world.z() * a.sin, world.y(),
                    world.x() * a.sin + world.z() * a.cos);
  return {turned.x(), turned.y() * b.cos + turned.z() * b.sin,
          turned.y() * b.sin + turned.z() * b.cos};
}

PrintedAngles printedAngles(const Axes& plane, const Axes& view) {
  const auto yaw = [](const Axes& axes) { return arcTangent(axes.out.y(), axes.out.x()); };
  const auto pitch = [](const Axes& axes) {
    const Vec3& o = axes.out;
    return arcTangent(o.z(), std::sqrt(o.x() * o.x() + o.y() * o.y()));
  };
  return {0.5 * PI - pitch(plane), yaw(view) - yaw(plane), -pitch(view)};
}

}  // namespace vegetation_sim::canopy
