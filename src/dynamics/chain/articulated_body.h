// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/chain/articulated.h"
#include "dynamics/chain/symmetric.h"

namespace vegetation_sim::physics {

// Motion of joints, and inertias about a joint: of a rigid link, a point, a child.

// Forces inlining in the sweeps: without it the compiler passes vectors through memory, once per
// link.
#define VEGETATION_SIM_INTO inline __attribute__((always_inline))

inline const BaseMotion GROUND;
inline const ArticulatedBody::Acceleration NONE{Vec3::Zero(), Vec3::Zero()};

inline const BaseMotion& baseOf(const Link& link, const std::vector<BaseMotion>& bases) {
  return bases.empty() ? GROUND : bases[static_cast<std::size_t>(link.base)];
}

// Returns the acceleration of a z axis that turns at `spin` and moves at `sweep` = spin x z.
VEGETATION_SIM_INTO Vec3 axisRate(const Vec3& spin_rate, const Vec3& spin, const Vec3& sweep,
                                  const Vec3& z, double products) {
  return cross(spin_rate, z) + products * cross(spin, sweep);
}

inline ArticulatedBody::FreeMotion freeMotionOf(const BaseMotion& base, double products) {
  const Vec3 z = axisZ(base.pose.orientation);
  return {base.spin_rate, base.acceleration,
          axisRate(base.spin_rate, base.spin, cross(base.spin, z), z, products)};
}

// `change` is what the joint's rates add to the rate of the spin; `spin` and `sweep` are the link's
// own.
VEGETATION_SIM_INTO void freeMotion(const ArticulatedBody::FreeMotion& parent, double h,
                                    const Vec3& change, const Vec3& spin, const Vec3& sweep,
                                    const Vec3& z, double products,
                                    ArticulatedBody::FreeMotion& out) {
  out.spin = parent.spin + products * change;
  out.linear = parent.linear + h * parent.axis;
  out.axis = axisRate(out.spin, spin, sweep, z, products);
}

VEGETATION_SIM_INTO Vec3 timesTransposedB(const ArticulatedBody::Body& body, const Vec3& v) {
  return v.x() * body.bx + v.y() * body.by + v.z() * body.bz;
}

VEGETATION_SIM_INTO Vec3 inAxes(const Axes& axes, const Vec3& v) {
  return v.x() * axes.x + v.y() * axes.y + v.z() * axes.z;
}

/// Leaves torque and force unchanged. Bars need no rotation of a full inertia.
VEGETATION_SIM_INTO void rigidBody(const Link& link, const Axes& axes, ArticulatedBody::Body& out) {
  Vec3 moment;
  if (isBar(link)) {
    moment = (link.mass * link.centre.z()) * axes.z;
    out.a = scaledIdentity(link.inertia.xx);
    addSquare(out.a, link.inertia.zz - link.inertia.xx, axes.z);
  } else {
    moment = link.mass * inAxes(axes, link.centre);
    out.a = turned(link.inertia, axes.x, axes.y, axes.z);
  }
  out.m = scaledIdentity(link.mass);
  out.bx = Vec3(0.0, -moment.z(), moment.y());
  out.by = Vec3(moment.z(), 0.0, -moment.x());
  out.bz = Vec3(-moment.y(), moment.x(), 0.0);
}

/// Returns the wrench that this motion of a link takes.
VEGETATION_SIM_INTO Wrench biasOf(const Link& link, const Axes& axes, const Vec3& spin,
                                  const Vec3& sweep, const ArticulatedBody::FreeMotion& free,
                                  double products) {
  if (isBar(link)) {
    const Vec3& z = axes.z;
    const double moment = link.mass * link.centre.z(), along = link.inertia.zz;
    return {link.mass * free.linear + moment * free.axis,
            cross(z, link.inertia.xx * free.axis + moment * free.linear) +
                (along * dot(z, free.spin)) * z + (products * along * dot(z, spin)) * sweep};
  }
  const Symmetric3 inertia = turned(link.inertia, axes.x, axes.y, axes.z);
  const Vec3 moment = link.mass * inAxes(axes, link.centre);
  const Vec3 turning =
      multiply(inertia, free.spin) + products * cross(spin, multiply(inertia, spin));
  return {link.mass * free.linear + cross(free.spin, moment) +
              products * cross(spin, cross(spin, moment)),
          turning + cross(moment, free.linear)};
}

/// Adds the effect of a drag over `s` seconds against linear acceleration: a mass at its point.
inline void addDrag(double s, const Drag& drag, ArticulatedBody::Body& body) {
  const double mass = s * drag.all;
  const Vec3 &arm = drag.arm, moment = mass * arm;
  add(body.a, 1.0, scaledIdentity(dot(moment, arm)));
  addSquare(body.a, -mass, arm);
  add(body.m, 1.0, scaledIdentity(mass));
  const Vec3 turn = cross(arm, drag.along), pull = s * drag.along;
  addSquare(body.a, s, turn);
  addSquare(body.m, s, drag.along);
  body.bx += Vec3(0.0, -moment.z(), moment.y()) + turn.x() * pull;
  body.by += Vec3(moment.z(), 0.0, -moment.x()) + turn.y() * pull;
  body.bz += Vec3(-moment.y(), moment.x(), 0.0) + turn.z() * pull;
}

/// Adds a mass `m` at `arm` from the joint, which counts against linear acceleration there.
inline void addPointMass(ArticulatedBody::Body& body, const Symmetric3& m, const Vec3& arm) {
  const Vec3 mx(m.xx, m.xy, m.xz), my(m.xy, m.yy, m.yz), mz(m.xz, m.yz, m.zz);
  // b += [arm x] m: column j is arm x m_j.
  const Vec3 cx = cross(arm, mx), cy = cross(arm, my), cz = cross(arm, mz);
  body.bx += Vec3(cx.x(), cy.x(), cz.x());
  body.by += Vec3(cx.y(), cy.y(), cz.y());
  body.bz += Vec3(cx.z(), cy.z(), cz.z());
  add(body.a, 1.0, aboutJoint(m, arm));
  add(body.m, 1.0, m);
}

/// Adds an articulated body whose joint is at `d` from the parent's: with b' = b + [d x] m, a +=
/// child.a + [d x] b^T + b' [d x]^T, of which the upper half is enough.
VEGETATION_SIM_INTO void addChild(const ArticulatedBody::Body& child, const Vec3& d,
                                  ArticulatedBody::Body& parent) {
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
