// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/dynamics/chain/chain.h"

namespace vegetation_sim::physics {

/// A bend by the rotation vector (x, y, 0) of size a: its rotation is (w, s x, s y, 0); b = (1 -
/// cos a) / a^2, c = (a - sin a) / a^3; db, dc: their derivatives by a, over a.
struct Bend {
  double w, s, b, c, db, dc;
};
Bend bendOf(const Vec2& q);

inline Quat rotationOf(const Bend& bend, const Vec2& q) {
  return {bend.w, bend.s * q.x(), bend.s * q.y(), 0.0};
}

inline Quat bendRotation(const Vec2& q) {
  return rotationOf(bendOf(q), q);
}

/// Axes of a rotated frame in the world.
struct Axes {
  Vec3 x, y, z;
};

inline Axes axesOf(const Quat& q) {
  const double x2 = q.x + q.x, y2 = q.y + q.y, z2 = q.z + q.z;
  const double xx = x2 * q.x, xy = x2 * q.y, xz = x2 * q.z, yy = y2 * q.y, yz = y2 * q.z,
               zz = z2 * q.z, wx = x2 * q.w, wy = y2 * q.w, wz = z2 * q.w;
  return {Vec3(1.0 - (yy + zz), xy + wz, xz - wy), Vec3(xy - wz, 1.0 - (xx + zz), yz + wx),
          Vec3(xz + wy, yz - wx, 1.0 - (xx + yy))};
}

/// Computes the spin of the bent link per rate of each bend, in the axes in which `axes` are given.
/// In the link's own axes the spin is (1 - b W + c W^2) times the rate, where W is the matrix of q
/// x.
inline void bendAxes(const Bend& bend, const Vec2& q, const Axes& axes, Vec3& first, Vec3& second) {
  const Vec3 p = (bend.c * q.y()) * axes.x - (bend.c * q.x()) * axes.y - bend.b * axes.z;
  first = axes.x - q.y() * p;
  second = axes.y + q.x() * p;
}

/// Returns the rate of change of the link's spin without acceleration of the bends [rad/s^2].
inline Vec3 bendBias(const Bend& bend, const Vec2& q, const Vec2& rate, const Axes& axes) {
  const double k = q.x() * rate.y() - q.y() * rate.x();
  const double swept = q.x() * rate.x() + q.y() * rate.y(), e = bend.dc * swept;
  return (k * (e * q.y() + bend.c * rate.y())) * axes.x -
         (k * (e * q.x() + bend.c * rate.x())) * axes.y - (k * (bend.db * swept)) * axes.z;
}

}  // namespace vegetation_sim::physics
