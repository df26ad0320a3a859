// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/dynamics/chain/chain.h"

namespace vegetation_sim::physics {

inline Symmetric3 scaledIdentity(double s) {
  return {s, s, s, 0.0, 0.0, 0.0};
}

inline Vec3 multiply(const Symmetric3& m, const Vec3& v) {
  return {m.xx * v.x() + m.xy * v.y() + m.xz * v.z(), m.xy * v.x() + m.yy * v.y() + m.yz * v.z(),
          m.xz * v.x() + m.yz * v.y() + m.zz * v.z()};
}

inline void add(Symmetric3& m, double s, const Symmetric3& n) {
  m.xx += s * n.xx;
  m.yy += s * n.yy;
  m.zz += s * n.zz;
  m.xy += s * n.xy;
  m.xz += s * n.xz;
  m.yz += s * n.yz;
}

/// m += s u u^T.
inline void addSquare(Symmetric3& m, double s, const Vec3& u) {
  const Vec3 t = s * u;
  m.xx += t.x() * u.x();
  m.yy += t.y() * u.y();
  m.zz += t.z() * u.z();
  m.xy += t.x() * u.y();
  m.xz += t.x() * u.z();
  m.yz += t.y() * u.z();
}

/// m -= u1 v1^T + u2 v2^T, a sum that is symmetric.
inline void subtractTwo(Symmetric3& m, const Vec3& u1, const Vec3& v1, const Vec3& u2,
                        const Vec3& v2) {
  m.xx -= u1.x() * v1.x() + u2.x() * v2.x();
  m.yy -= u1.y() * v1.y() + u2.y() * v2.y();
  m.zz -= u1.z() * v1.z() + u2.z() * v2.z();
  m.xy -= u1.x() * v1.y() + u2.x() * v2.y();
  m.xz -= u1.x() * v1.z() + u2.x() * v2.z();
  m.yz -= u1.y() * v1.z() + u2.y() * v2.z();
}

/// m += s (u v^T + v u^T).
inline void addPair(Symmetric3& m, double s, const Vec3& u, const Vec3& v) {
  const Vec3 t = s * u;
  m.xx += 2.0 * (t.x() * v.x());
  m.yy += 2.0 * (t.y() * v.y());
  m.zz += 2.0 * (t.z() * v.z());
  m.xy += t.x() * v.y() + t.y() * v.x();
  m.xz += t.x() * v.z() + t.z() * v.x();
  m.yz += t.y() * v.z() + t.z() * v.y();
}

/// [arm x] m [arm x]^T: the inertia about a joint of a mass `m` at `arm` from it.
inline Symmetric3 aboutJoint(const Symmetric3& m, const Vec3& arm) {
  const Vec3 cx = cross(arm, Vec3(m.xx, m.xy, m.xz)), cy = cross(arm, Vec3(m.xy, m.yy, m.yz)),
             cz = cross(arm, Vec3(m.xz, m.yz, m.zz));
  const Vec3 ax = cross(arm, Vec3(cx.x(), cy.x(), cz.x())),
             ay = cross(arm, Vec3(cx.y(), cy.y(), cz.y())),
             az = cross(arm, Vec3(cx.z(), cy.z(), cz.z()));
  return {ax.x(), ay.y(), az.z(), ax.y(), ax.z(), ay.z()};
}

/// Returns the matrix in other axes, in which the own axes are x, y, z.
inline Symmetric3 turned(const Symmetric3& m, const Vec3& x, const Vec3& y, const Vec3& z) {
  Symmetric3 out = scaledIdentity(m.yy);  // because x x^T + y y^T + z z^T is one
  addSquare(out, m.xx - m.yy, x);
  addSquare(out, m.zz - m.yy, z);
  if (m.xy != 0.0) addPair(out, m.xy, x, y);
  if (m.xz != 0.0) addPair(out, m.xz, x, z);
  if (m.yz != 0.0) addPair(out, m.yz, y, z);
  return out;
}

}  // namespace vegetation_sim::physics
