// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::crowd {

/// All points within `radius` of a box, which may be flat in one, two or all three directions: so
/// also a sphere, a capsule, a point, a segment and a rectangle.
struct Box {
  Vec3 centre{Vec3::Zero()};                                                ///< [m]
  std::array<Vec3, 3> axes{{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}};  ///< orthonormal
  Vec3 half{Vec3::Zero()};                                                  ///< edges [m]
  double radius{0.0};                                                       ///< [m]
};

/// All points within `radius` of the convex hull of at least one point.
struct Hull {
  std::vector<Vec3> points;  ///< [m]
  double radius{0.0};        ///< [m]
};

Box ballAt(const Vec3& centre, double radius);
/// Axis from `base` to `tip`, which may coincide.
Box capsuleBetween(const Vec3& base, const Vec3& tip, double radius);
/// Standing on its third axis, turned by `yaw` [rad].
Box uprightBox(const Vec3& centre, const Vec3& half, double yaw);

/// How far apart two shapes are, with the proof: `lower <= true distance <= upper`, up to rounding.
struct Separation {
  double lower{0.0}, upper{0.0};  ///< [m]; both 0 where the shapes overlap
  double gap{0.0};  ///< `upper`, or less than 0 by the depth to which roundings overlap [m]
  Vec3 normal{Vec3::Zero()};  ///< unit, from first to second; zero where even the cores overlap
  bool overlapping{false};    ///< touching counts
  bool cores_overlap{false};  ///< the boxes or hulls themselves: `gap` then is only minus the radii
  int rounds{0};

  double distance() const { return upper; }
};

/// Nearest distance by the algorithm of Gilbert, Johnson and Keerthi (1988), own double version:
/// works in a frame about one shape, keeps the best bound of all rounds, and takes no depth.
/// Stops as soon as the distance is known to be more than `enough` [m]; `upper` then is loose.
Separation separation(const Box& a, const Box& b,
                      double enough = std::numeric_limits<double>::infinity());
Separation separation(const Box& a, const Hull& b,
                      double enough = std::numeric_limits<double>::infinity());
Separation separation(const Hull& a, const Hull& b,
                      double enough = std::numeric_limits<double>::infinity());

}  // namespace vegetation_sim::crowd
