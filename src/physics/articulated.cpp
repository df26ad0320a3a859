// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/physics/articulated.h"

#include "physics/bend.h"
#include "physics/symmetric.h"

namespace vegetation_sim::physics {
namespace {

using Body = ArticulatedBody::Body;
using Joint = ArticulatedBody::Joint;

const BaseMotion GROUND;

const BaseMotion& baseOf(const Link& link, const std::vector<BaseMotion>& bases) {
  return bases.empty() ? GROUND : bases[static_cast<std::size_t>(link.base)];
}

Vec3 timesB(const Body& body, const Vec3& v) {
  return {dot(body.bx, v), dot(body.by, v), dot(body.bz, v)};
}

Vec3 timesTransposedB(const Body& body, const Vec3& v) {
  return v.x() * body.bx + v.y() * body.by + v.z() * body.bz;
}

Body rigidBody(const Link& link, const Quat& q, const Vec3& spin, const Wrench& load,
               double products) {
  const Vec3 x = axisX(q), y = axisY(q), z = axisZ(q);
  const Vec3 moment = link.mass * (link.centre.x() * x + link.centre.y() * y + link.centre.z() * z);
  Body out;
  out.a = turned(link.inertia, x, y, z);
  out.m = scaledIdentity(link.mass);
  out.bx = Vec3(0.0, -moment.z(), moment.y());
  out.by = Vec3(moment.z(), 0.0, -moment.x());
  out.bz = Vec3(-moment.y(), moment.x(), 0.0);
  out.torque = products * cross(spin, multiply(out.a, spin)) - load.torque;
  out.force = products * cross(spin, cross(spin, moment)) - load.force;
  return out;
}

// Mass `m` at `arm` from the joint: it counts against linear acceleration there.
void addPointMass(Body& body, const Symmetric3& m, const Vec3& arm) {
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
void addChild(const Body& child, const Vec3& d, Body& parent) {
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

}  // namespace

void ArticulatedBody::sweepOut(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                               const ChainState& state, const Kinematics& k, const Loads& loads,
                               double products) {
  const std::size_t n = links.size();
  joints_.resize(n);
  bodies_.resize(n);
  gains_.resize(n);
  spin_rate_.resize(n);
  acceleration_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Link& link = links[i];
    const bool root = link.parent < 0;
    const auto p = static_cast<std::size_t>(root ? 0 : link.parent);
    const Pose& from = root ? baseOf(link, bases).pose : k.pose[p];
    const Vec3 spin = root ? baseOf(link, bases).spin : k.spin[p];
    const Quat& q = k.pose[i].orientation;
    bodies_[i] = rigidBody(link, q, k.spin[i], loads.wrench[i], products);
    const BendMotion bend = bendMotion(state.q[i], state.rate[i]);
    Joint& joint = joints_[i];
    joint.first = rotate(q, bend.first);
    joint.second = rotate(q, bend.second);
    joint.offset = link.h * axisZ(from.orientation);
    joint.linear_bias = products * cross(spin, cross(spin, joint.offset));
    joint.spin_bias = products * (rotate(q, bend.bias) + cross(spin, Vec3(k.spin[i] - spin)));
  }
}

// An implicit spring resists the motion that accelerations of the joints add; what the links do
// without them is in the predicted pose already, so it is taken out again.
void ArticulatedBody::foreseeAnchors(const std::vector<Link>& links,
                                     const std::vector<BaseMotion>& bases, const Loads& loads,
                                     const Implicitness& implicitness) {
  if (loads.anchors.empty()) return;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const bool root = links[i].parent < 0;
    const auto p = static_cast<std::size_t>(root ? 0 : links[i].parent);
    const Vec3 turn = root ? baseOf(links[i], bases).spin_rate : spin_rate_[p];
    const Vec3 pull = root ? baseOf(links[i], bases).acceleration : acceleration_[p];
    spin_rate_[i] = turn + joints_[i].spin_bias;
    acceleration_[i] = pull + cross(turn, joints_[i].offset) + joints_[i].linear_bias;
  }
  for (const Anchor& anchor : loads.anchors) {
    const auto i = static_cast<std::size_t>(anchor.link);
    Body& body = bodies_[i];
    body.torque -= cross(anchor.arm, anchor.force);
    body.force -= anchor.force;
    Symmetric3 mass;
    add(mass, implicitness.stiffness, anchor.stiffness);
    add(mass, implicitness.damping, anchor.damping);
    const Vec3 known = multiply(mass, acceleration_[i] + cross(spin_rate_[i], anchor.arm));
    addPointMass(body, mass, anchor.arm);
    body.torque -= cross(anchor.arm, known);
    body.force -= known;
  }
}

void ArticulatedBody::sweepBack(const std::vector<Link>& links, const ChainState& state,
                                const Loads& loads, const Implicitness& implicitness) {
  for (std::size_t i = links.size(); i-- > 0;) {
    const Link& link = links[i];
    const Joint& joint = joints_[i];
    Body& body = bodies_[i];
    Gain& gain = gains_[i];
    gain.a1 = multiply(body.a, joint.first);
    gain.a2 = multiply(body.a, joint.second);
    gain.b1 = timesTransposedB(body, joint.first);
    gain.b2 = timesTransposedB(body, joint.second);
    const double foreseen =
        implicitness.stiffness * link.stiffness + implicitness.damping * link.damping;
    const double d11 = dot(joint.first, gain.a1) + foreseen;
    const double d12 = dot(joint.first, gain.a2);
    const double d22 = dot(joint.second, gain.a2) + foreseen;
    const double scale = 1.0 / (d11 * d22 - d12 * d12);
    gain.i11 = d22 * scale;
    gain.i12 = -d12 * scale;
    gain.i22 = d11 * scale;
    body.torque += multiply(body.a, joint.spin_bias) + timesB(body, joint.linear_bias);
    body.force += timesTransposedB(body, joint.spin_bias) + multiply(body.m, joint.linear_bias);
    const Vec2 &q = state.q[i], &rate = state.rate[i], &extra = loads.joint_torque[i];
    gain.torque1 = extra.x() - link.stiffness * q.x() - link.damping * rate.x() -
                   dot(joint.first, body.torque);
    gain.torque2 = extra.y() - link.stiffness * q.y() - link.damping * rate.y() -
                   dot(joint.second, body.torque);
    if (link.parent < 0) continue;
    // Columns of U D^-1.
    const Vec3 wa1 = gain.i11 * gain.a1 + gain.i12 * gain.a2;
    const Vec3 wa2 = gain.i12 * gain.a1 + gain.i22 * gain.a2;
    const Vec3 wb1 = gain.i11 * gain.b1 + gain.i12 * gain.b2;
    const Vec3 wb2 = gain.i12 * gain.b1 + gain.i22 * gain.b2;
    Body& passed = body;  // needed no more as it is
    subtractTwo(passed.a, wa1, gain.a1, wa2, gain.a2);
    subtractTwo(passed.m, wb1, gain.b1, wb2, gain.b2);
    passed.bx -= wa1.x() * gain.b1 + wa2.x() * gain.b2;
    passed.by -= wa1.y() * gain.b1 + wa2.y() * gain.b2;
    passed.bz -= wa1.z() * gain.b1 + wa2.z() * gain.b2;
    passed.torque += gain.torque1 * wa1 + gain.torque2 * wa2;
    passed.force += gain.torque1 * wb1 + gain.torque2 * wb2;
    addChild(passed, joint.offset, bodies_[static_cast<std::size_t>(link.parent)]);
  }
}

void ArticulatedBody::accelerations(const std::vector<Link>& links,
                                    const std::vector<BaseMotion>& bases, const ChainState& state,
                                    const Kinematics& kinematics, const Loads& loads,
                                    const Implicitness& implicitness, std::vector<Vec2>& out) {
  sweepOut(links, bases, state, kinematics, loads, implicitness.products);
  foreseeAnchors(links, bases, loads, implicitness);
  sweepBack(links, state, loads, implicitness);
  out.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    const bool root = links[i].parent < 0;
    const auto p = static_cast<std::size_t>(root ? 0 : links[i].parent);
    const Joint& joint = joints_[i];
    const Gain& gain = gains_[i];
    const Vec3 turn = root ? baseOf(links[i], bases).spin_rate : spin_rate_[p];
    const Vec3 linear = (root ? baseOf(links[i], bases).acceleration : acceleration_[p]) +
                        cross(turn, joint.offset);
    const double t1 = gain.torque1 - dot(gain.a1, turn) - dot(gain.b1, linear);
    const double t2 = gain.torque2 - dot(gain.a2, turn) - dot(gain.b2, linear);
    out[i] = Vec2(gain.i11 * t1 + gain.i12 * t2, gain.i12 * t1 + gain.i22 * t2);
    spin_rate_[i] = turn + joint.spin_bias + out[i].x() * joint.first + out[i].y() * joint.second;
    acceleration_[i] = linear + joint.linear_bias;
  }
}

void ArticulatedBody::torques(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                              const ChainState& state, const Kinematics& kinematics,
                              const Loads& loads, const std::vector<Vec2>& acceleration,
                              std::vector<Vec2>& out) {
  sweepOut(links, bases, state, kinematics, loads, 1.0);
  foreseeAnchors(links, bases, loads, {});
  for (std::size_t i = 0; i < links.size(); ++i) {
    const bool root = links[i].parent < 0;
    const auto p = static_cast<std::size_t>(root ? 0 : links[i].parent);
    const Joint& joint = joints_[i];
    const Vec3 turn = root ? baseOf(links[i], bases).spin_rate : spin_rate_[p];
    const Vec3 pull = root ? baseOf(links[i], bases).acceleration : acceleration_[p];
    spin_rate_[i] = turn + joint.spin_bias + acceleration[i].x() * joint.first +
                    acceleration[i].y() * joint.second;
    acceleration_[i] = pull + cross(turn, joint.offset) + joint.linear_bias;
  }
  out.resize(links.size());
  for (std::size_t i = links.size(); i-- > 0;) {
    const Link& link = links[i];
    Body& body = bodies_[i];
    body.torque += multiply(body.a, spin_rate_[i]) + timesB(body, acceleration_[i]);
    body.force += timesTransposedB(body, spin_rate_[i]) + multiply(body.m, acceleration_[i]);
    const Vec2 &q = state.q[i], &rate = state.rate[i];
    out[i] = Vec2(
        dot(joints_[i].first, body.torque) + link.stiffness * q.x() + link.damping * rate.x(),
        dot(joints_[i].second, body.torque) + link.stiffness * q.y() + link.damping * rate.y());
    if (link.parent < 0) continue;
    Body& parent = bodies_[static_cast<std::size_t>(link.parent)];
    parent.torque += body.torque + cross(joints_[i].offset, body.force);
    parent.force += body.force;
  }
}

}  // namespace vegetation_sim::physics
