// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/chain/articulated.h"
#include "dynamics/chain/symmetric.h"

namespace vegetation_sim::physics {

void kinematicsOf(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                  const ChainState& state, Kinematics& out) {
  const std::size_t n = links.size();
  const BaseMotion ground;
  out.pose.resize(n);
  out.spin.resize(n);
  out.velocity.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Link& link = links[i];
    const auto p = static_cast<std::size_t>(link.parent < 0 ? 0 : link.parent);
    const BaseMotion& base = bases.empty() ? ground : bases[static_cast<std::size_t>(link.base)];
    const bool root = link.parent < 0;
    const Pose& from = root ? base.pose : out.pose[p];
    const Vec3 spin = root ? base.spin : out.spin[p];
    const Vec3 velocity = root ? base.velocity : out.velocity[p];
    const Vec3 offset = link.h * axisZ(from.orientation);
    Pose& pose = out.pose[i];
    pose.position = from.position + offset;
    const Vec2 &q = state.q[i], &rate = state.rate[i];
    const Bend bend = bendOf(q);
    pose.orientation = from.orientation * (link.rest * rotationOf(bend, q));
    Vec3 first, second;
    bendAxes(bend, q, axesOf(pose.orientation), first, second);
    out.spin[i] = spin + rate.x() * first + rate.y() * second;
    out.velocity[i] = velocity + cross(spin, offset);
  }
}

namespace {

// Returns the inertia about the joint, world axes.
Symmetric3 inertiaOf(const Link& link, const Quat& q) {
  return turned(link.inertia, axisX(q), axisY(q), axisZ(q));
}

}  // namespace

Momentum momentumOf(const std::vector<Link>& links, const Kinematics& k) {
  Momentum out;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Vec3 arm = rotate(k.pose[i].orientation, links[i].centre);
    const Vec3 linear = links[i].mass * (k.velocity[i] + cross(k.spin[i], arm));
    const Vec3 angular = multiply(inertiaOf(links[i], k.pose[i].orientation), k.spin[i]) +
                         links[i].mass * cross(arm, k.velocity[i]);
    out.linear += linear;
    out.angular += angular + cross(k.pose[i].position, linear);
  }
  return out;
}

double energyOf(const std::vector<Link>& links, const ChainState& state, const Kinematics& k) {
  double sum = 0.0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Link& link = links[i];
    const Vec3 arm = rotate(k.pose[i].orientation, link.centre);
    const Vec3 turning = multiply(inertiaOf(link, k.pose[i].orientation), k.spin[i]);
    sum += 0.5 * dot(k.spin[i], turning) + 0.5 * link.mass * dot(k.velocity[i], k.velocity[i]) +
           link.mass * dot(k.velocity[i], cross(k.spin[i], arm));
    const Vec2& q = state.q[i];
    sum += 0.5 * link.stiffness * (q.x() * q.x() + q.y() * q.y());
  }
  return sum;
}

}  // namespace vegetation_sim::physics
