// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "physics/articulated_body.h"

namespace vegetation_sim::physics {

// Mass `m` at `arm` from the joint: it counts against linear acceleration there.
void addPointMass(ArticulatedBody::Body& body, const Symmetric3& m, const Vec3& arm) {
  const Vec3 mx(m.xx, m.xy, m.xz), my(m.xy, m.yy, m.yz), mz(m.xz, m.yz, m.zz);
  // b += [arm x] m: column j is arm x m_j.
  const Vec3 cx = cross(arm, mx), cy = cross(arm, my), cz = cross(arm, mz);
  body.bx += Vec3(cx.x(), cy.x(), cz.x());
  body.by += Vec3(cx.y(), cy.y(), cz.y());
  body.bz += Vec3(cx.z(), cy.z(), cz.z());
  add(body.a, 1.0, aboutJoint(m, arm));
  add(body.m, 1.0, m);
}

// Adds an articulated body whose joint is at `d` from the parent's: with b' = b + [d x] m,
// a += child.a + [d x] b^T + b' [d x]^T, of which the upper half is enough.
void addChild(const ArticulatedBody::Body& child, const Vec3& d, ArticulatedBody::Body& parent) {
  const Symmetric3& m = child.m;
  const Vec3 mx = cross(d, Vec3(m.xx, m.xy, m.xz)), my = cross(d, Vec3(m.xy, m.yy, m.yz)),
             mz = cross(d, Vec3(m.xz, m.yz, m.zz));
  const Vec3 bx = child.bx + Vec3(mx.x(), my.x(), mz.x()),
             by = child.by + Vec3(mx.y(), my.y(), mz.y()),
             bz = child.bz + Vec3(mx.z(), my.z(), mz.z());
  const Vec3 px = cross(d, child.bx), py = cross(d, child.by), pz = cross(d, child.bz);
  const Vec3 qx = cross(d, bx), qy = cross(d, by), qz = cross(d, bz);
  parent.a.xx += child.a.xx + px.x() + qx.x();
  parent.a.yy += child.a.yy + py.y() + qy.y();
  parent.a.zz += child.a.zz + pz.z() + qz.z();
  parent.a.xy += child.a.xy + py.x() + qx.y();
  parent.a.xz += child.a.xz + pz.x() + qx.z();
  parent.a.yz += child.a.yz + pz.y() + qy.z();
  parent.bx += bx;
  parent.by += by;
  parent.bz += bz;
  add(parent.m, 1.0, m);
  parent.torque += child.torque + cross(d, child.force);
  parent.force += child.force;
}

}  // namespace vegetation_sim::physics
