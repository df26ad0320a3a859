// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/chain/articulated_body.h"

namespace vegetation_sim::physics {

// Adds a mass `m` at `arm` from the joint, which counts against linear acceleration there.
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

}  // namespace vegetation_sim::physics
