// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "physics/bar.h"
#include "physics/symmetric.h"
#include "vegetation_sim/physics/articulated.h"

namespace vegetation_sim::physics {

// Motion of joints; inertias about a joint: a rigid link's, a point's, a child's.

inline const BaseMotion GROUND;
inline const ArticulatedBody::Acceleration NONE{Vec3::Zero(), Vec3::Zero()};

inline const BaseMotion& baseOf(const Link& link, const std::vector<BaseMotion>& bases) {
  return bases.empty() ? GROUND : bases[static_cast<std::size_t>(link.base)];
}

inline ArticulatedBody::Acceleration accelerationOf(const BaseMotion& base) {
  return {base.spin_rate, base.acceleration};
}

// What a link does if its joint does not accelerate; `own`: spin that the joint adds, `change`: its
// own rate.
inline ArticulatedBody::Acceleration freeMotion(const ArticulatedBody::Acceleration& parent,
                                                const Vec3& spin, const Vec3& own,
                                                const Vec3& change, const Vec3& offset,
                                                double products) {
  return {parent.spin + products * (change + cross(spin, own)),
          parent.linear + cross(parent.spin, offset) + products * cross(spin, cross(spin, offset))};
}

inline ArticulatedBody::Acceleration pushed(const ArticulatedBody::Acceleration& parent,
                                            const ArticulatedBody::Joint& joint,
                                            const Vec2& acceleration) {
  return {parent.spin + acceleration.x() * joint.first + acceleration.y() * joint.second,
          parent.linear + cross(parent.spin, joint.offset)};
}

inline Vec3 timesB(const ArticulatedBody::Body& body, const Vec3& v) {
  return {dot(body.bx, v), dot(body.by, v), dot(body.bz, v)};
}

inline Vec3 timesTransposedB(const ArticulatedBody::Body& body, const Vec3& v) {
  return v.x() * body.bx + v.y() * body.by + v.z() * body.bz;
}

inline Vec3 inAxes(const Axes& axes, const Vec3& v) {
  return v.x() * axes.x + v.y() * axes.y + v.z() * axes.z;
}

/// Leaves torque and force alone. Bars need no rotation of a full inertia.
inline void rigidBody(const Link& link, const Axes& axes, ArticulatedBody::Body& out) {
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

/// What it takes to move a link at this spin with these accelerations.
inline Wrench biasOf(const Link& link, const Axes& axes, const Vec3& spin,
                     const ArticulatedBody::Acceleration& free, double products) {
  Vec3 moment, turning;
  if (isBar(link)) {
    const double excess = link.inertia.zz - link.inertia.xx;
    moment = (link.mass * link.centre.z()) * axes.z;
    turning = link.inertia.xx * free.spin + (excess * dot(axes.z, free.spin)) * axes.z +
              (products * excess * dot(axes.z, spin)) * cross(spin, axes.z);
  } else {
    const Symmetric3 inertia = turned(link.inertia, axes.x, axes.y, axes.z);
    moment = link.mass * inAxes(axes, link.centre);
    turning = multiply(inertia, free.spin) + products * cross(spin, multiply(inertia, spin));
  }
  return {link.mass * free.linear + cross(free.spin, moment) +
              products * cross(spin, cross(spin, moment)),
          turning + cross(moment, free.linear)};
}

/// Mass `m` at `arm` from the joint: it counts against linear acceleration there.
void addPointMass(ArticulatedBody::Body& body, const Symmetric3& m, const Vec3& arm);

/// Adds an articulated body whose joint is at `d` from the parent's.
void addChild(const ArticulatedBody::Body& child, const Vec3& d, ArticulatedBody::Body& parent);

}  // namespace vegetation_sim::physics
