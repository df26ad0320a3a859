// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::crowd {

/// All points within `radius` of a box, which may be flat in one, two or three directions. It thus
/// represents spheres, capsules, points, segments and rectangles, too.
struct Box {
  Vec3 centre{Vec3::Zero()};                                                ///< [m]
  std::array<Vec3, 3> axes{{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}};  ///< orthonormal
  Vec3 half{Vec3::Zero()};                                                  ///< half edges [m]
  double radius{0.0};                                                       ///< [m]
};

/// All points within `radius` of the convex hull of at least one point.
struct Hull {
  std::vector<Vec3> points;  ///< [m]
  double radius{0.0};        ///< [m]
};

Box ballAt(const Vec3& centre, double radius);
/// Makes a capsule whose axis runs from `base` to `tip`, which may coincide.
Box capsuleBetween(const Vec3& base, const Vec3& tip, double radius);
/// Makes a box that stands on its third axis, turned by `yaw` [rad].
Box uprightBox(const Vec3& centre, const Vec3& half, double yaw);

/// Distance of two shapes with guaranteed bounds: `lower <= true distance <= upper`, up to
/// rounding.
struct Separation {
  double lower{0.0}, upper{0.0};  ///< bounds; both 0 if the shapes overlap [m]
  double gap{0.0};                ///< `upper`, or minus the depth of the overlap of the radii [m]
  Vec3 normal{Vec3::Zero()};      ///< unit, from first to second; zero if the cores overlap
  bool overlapping{false};        ///< true if they touch or overlap
  /// The boxes or hulls themselves overlap; `gap` is then only minus the radii.
  bool cores_overlap{false};
  int rounds{0};

  double distance() const { return upper; }
};

/// Computes the distance by the algorithm of Gilbert, Johnson and Keerthi (1988), in double
/// precision: in a frame about one shape, keeping the best bounds of all iterations, without
/// penetration depth. Stops as soon as the distance is known to be more than `enough` [m]; `upper`
/// is then not tight.
Separation separation(const Box& a, const Box& b,
                      double enough = std::numeric_limits<double>::infinity());
Separation separation(const Box& a, const Hull& b,
                      double enough = std::numeric_limits<double>::infinity());
Separation separation(const Hull& a, const Hull& b,
                      double enough = std::numeric_limits<double>::infinity());

}  // namespace vegetation_sim::crowd
