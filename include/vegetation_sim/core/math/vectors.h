// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace vegetation_sim {

using Vec3 = Eigen::Vector3d;

/// Rotation w + xi + yj + zk of unit norm. Its products are its own, so that the order of
/// operations, and with it every bit, is the same on each processor (Eigen's follow the instruction
/// set).
struct Quat {
  double w{1.0}, x{0.0}, y{0.0}, z{0.0};
};

/// Frame of a branch in its tree's frame: origin [m] and orientation.
struct Pose {
  Vec3 position{Vec3::Zero()};
  Quat orientation{};
};

/// Returns rotation `a` after rotation `b`: the Hamilton product a b.
inline Quat operator*(const Quat& a, const Quat& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

inline Quat conjugate(const Quat& q) {
  return {q.w, -q.x, -q.y, -q.z};
}

inline double normOf(const Quat& q) {
  return std::sqrt(q.w * q.w + q.x * q.x + (q.y * q.y + q.z * q.z));
}

inline Quat normalized(const Quat& q) {
  const double f = 1.0 / normOf(q);
  return {q.w * f, q.x * f, q.y * f, q.z * f};
}

inline Vec3 axisX(const Quat& q) {
  return {1.0 - 2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y + q.w * q.z),
          2.0 * (q.x * q.z - q.w * q.y)};
}
inline Vec3 axisY(const Quat& q) {
  return {2.0 * (q.x * q.y - q.w * q.z), 1.0 - 2.0 * (q.x * q.x + q.z * q.z),
          2.0 * (q.y * q.z + q.w * q.x)};
}
inline Vec3 axisZ(const Quat& q) {
  return {2.0 * (q.x * q.z + q.w * q.y), 2.0 * (q.y * q.z - q.w * q.x),
          1.0 - 2.0 * (q.x * q.x + q.y * q.y)};
}

inline Vec3 rotate(const Quat& q, const Vec3& v) {
  const Vec3 x = axisX(q), y = axisY(q), z = axisZ(q);
  return {x.x() * v.x() + y.x() * v.y() + z.x() * v.z(),
          x.y() * v.x() + y.y() * v.y() + z.y() * v.z(),
          x.z() * v.x() + y.z() * v.y() + z.z() * v.z()};
}

/// Dot product with a fixed order of summation.
inline double dot(const Vec3& a, const Vec3& b) {
  return (a.x() * b.x() + a.y() * b.y()) + a.z() * b.z();
}

inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
          a.x() * b.y() - a.y() * b.x()};
}

inline double length(const Vec3& a) {
  return std::sqrt(dot(a, a));
}

}  // namespace vegetation_sim
