// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/physics/articulated.h"

#include "physics/articulated_body.h"
#include "physics/bend.h"

namespace vegetation_sim::physics {
namespace {

using Acceleration = ArticulatedBody::Acceleration;
using Joint = ArticulatedBody::Joint;

const BaseMotion GROUND;
const Acceleration NONE{Vec3::Zero(), Vec3::Zero()};

const BaseMotion& baseOf(const Link& link, const std::vector<BaseMotion>& bases) {
  return bases.empty() ? GROUND : bases[static_cast<std::size_t>(link.base)];
}

Acceleration accelerationOf(const BaseMotion& base) {
  return {base.spin_rate, base.acceleration};
}

// What a link does if its joint does not accelerate; `own`: spin that the joint adds, `change`: the
// rate of that in the link's axes.
Acceleration freeMotion(const Acceleration& parent, const Vec3& spin, const Vec3& own,
                        const Vec3& change, const Vec3& offset, double products) {
  return {parent.spin + products * (change + cross(spin, own)),
          parent.linear + cross(parent.spin, offset) + products * cross(spin, cross(spin, offset))};
}

Acceleration pushed(const Acceleration& parent, const Joint& joint, const Vec2& acceleration) {
  return {parent.spin + acceleration.x() * joint.first + acceleration.y() * joint.second,
          parent.linear + cross(parent.spin, joint.offset)};
}

}  // namespace

void ArticulatedBody::sweepOut(const Links& links, const Bases& bases, const ChainState& state,
                               const Kinematics& k, double products) {
  const std::size_t n = links.size();
  joints_.resize(n);
  bodies_.resize(n);
  free_.resize(n);
  push_.resize(n);
  bias_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Link& link = links[i];
    const bool root = link.parent < 0;
    const auto p = static_cast<std::size_t>(root ? 0 : link.parent);
    const BaseMotion& base = baseOf(link, bases);
    const Vec3 spin = root ? base.spin : k.spin[p];
    const Vec2& q = state.q[i];
    const Bend bend = bendOf(q);
    const Axes axes = axesOf(k.pose[i].orientation);
    Joint& joint = joints_[i];
    bendAxes(bend, q, axes, joint.first, joint.second);
    joint.offset = link.h * axisZ(root ? base.pose.orientation : k.pose[p].orientation);
    free_[i] = freeMotion(root ? accelerationOf(base) : free_[p], spin, k.spin[i] - spin,
                          bendBias(bend, q, state.rate[i], axes), joint.offset, products);
    rigidBody(link, axes, bodies_[i]);
    bias_[i] = biasOf(link, axes, k.spin[i], free_[i], products);
    bodies_[i].torque = bias_[i].torque;
    bodies_[i].force = bias_[i].force;
  }
}

// An implicit spring resists the motion that accelerations of the joints add: a mass; what the
// links do without them is in the predicted pose already.
void ArticulatedBody::addLoads(const Loads& loads, const Implicitness& implicitness) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    bodies_[i].torque -= loads.wrench[i].torque;
    bodies_[i].force -= loads.wrench[i].force;
  }
  for (const Anchor& anchor : loads.anchors) {
    Body& body = bodies_[static_cast<std::size_t>(anchor.link)];
    body.torque -= cross(anchor.arm, anchor.force);
    body.force -= anchor.force;
    Symmetric3 mass;
    add(mass, implicitness.stiffness, anchor.stiffness);
    add(mass, implicitness.damping, anchor.damping);
    addPointMass(body, mass, anchor.arm);
  }
}

void ArticulatedBody::sweepBack(const Links& links, const ChainState& state, const Loads& loads,
                                const Implicitness& implicitness) {
  positive_ = true;
  gains_.resize(links.size());
  for (std::size_t i = links.size(); i-- > 0;) {
    const Link& link = links[i];
    const Joint& joint = joints_[i];
    Body& body = bodies_[i];
    Gain& gain = gains_[i];
    const double foreseen = implicitness.foreseen(link);
    gain.a1 = multiply(body.a, joint.first);
    gain.b1 = timesTransposedB(body, joint.first);
    gain.a2 = multiply(body.a, joint.second);
    gain.b2 = timesTransposedB(body, joint.second);
    const double pivot1 = dot(joint.first, gain.a1) + foreseen;
    gain.inverse1 = 1.0 / pivot1;
    const double across = dot(joint.first, gain.a2);
    gain.coupling = across * gain.inverse1;
    const double pivot2 = dot(joint.second, gain.a2) + foreseen - gain.coupling * across;
    gain.inverse2 = 1.0 / pivot2;
    positive_ = positive_ && pivot1 > 0.0 && pivot2 > 0.0;
    gain.a2 -= gain.coupling * gain.a1;
    gain.b2 -= gain.coupling * gain.b1;
    const Vec2 &q = state.q[i], &rate = state.rate[i], &extra = loads.joint_torque[i];
    gain.drive1 = extra.x() - (link.stiffness * q.x() + link.damping * rate.x()) -
                  dot(joint.first, body.torque);
    gain.drive2 = extra.y() - (link.stiffness * q.y() + link.damping * rate.y()) -
                  dot(joint.second, body.torque) - gain.coupling * gain.drive1;
    if (link.parent < 0) continue;
    const Vec3 pa1 = gain.inverse1 * gain.a1, pa2 = gain.inverse2 * gain.a2;
    const Vec3 pb1 = gain.inverse1 * gain.b1, pb2 = gain.inverse2 * gain.b2;
    Body& passed = body;  // needed no more as it is
    subtractTwo(passed.a, pa1, gain.a1, pa2, gain.a2);
    subtractTwo(passed.m, pb1, gain.b1, pb2, gain.b2);
    passed.bx -= pa1.x() * gain.b1 + pa2.x() * gain.b2;
    passed.by -= pa1.y() * gain.b1 + pa2.y() * gain.b2;
    passed.bz -= pa1.z() * gain.b1 + pa2.z() * gain.b2;
    passed.torque += gain.drive1 * pa1 + gain.drive2 * pa2;
    passed.force += gain.drive1 * pb1 + gain.drive2 * pb2;
    addChild(passed, joint.offset, bodies_[static_cast<std::size_t>(link.parent)]);
  }
}

// What the joints must do under the wrenches in bodies_ alone, inertias as they were.
void ArticulatedBody::sweepWrenches(const Links& links) {
  for (std::size_t i = links.size(); i-- > 0;) {
    const Joint& joint = joints_[i];
    Body& body = bodies_[i];
    Gain& gain = gains_[i];
    gain.drive1 = -dot(joint.first, body.torque);
    gain.drive2 = -dot(joint.second, body.torque) - gain.coupling * gain.drive1;
    if (links[i].parent < 0) continue;
    Body& parent = bodies_[static_cast<std::size_t>(links[i].parent)];
    const double x1 = gain.inverse1 * gain.drive1, x2 = gain.inverse2 * gain.drive2;
    const Vec3 force = body.force + x1 * gain.b1 + x2 * gain.b2;
    parent.torque += body.torque + x1 * gain.a1 + x2 * gain.a2 + cross(joint.offset, force);
    parent.force += force;
  }
}

void ArticulatedBody::settle(const Links& links, std::vector<Vec2>& out) {
  out.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Acceleration& parent =
        links[i].parent < 0 ? NONE : push_[static_cast<std::size_t>(links[i].parent)];
    const Joint& joint = joints_[i];
    const Gain& gain = gains_[i];
    const Vec3 linear = parent.linear + cross(parent.spin, joint.offset);
    const double second =
        gain.inverse2 * (gain.drive2 - dot(gain.a2, parent.spin) - dot(gain.b2, linear));
    const double first =
        gain.inverse1 * (gain.drive1 - dot(gain.a1, parent.spin) - dot(gain.b1, linear)) -
        gain.coupling * second;
    out[i] = Vec2(first, second);
    push_[i] = {parent.spin + first * joint.first + second * joint.second, linear};
  }
}

void ArticulatedBody::accelerations(const std::vector<Link>& links,
                                    const std::vector<BaseMotion>& bases, const ChainState& state,
                                    const Kinematics& kinematics, const Loads& loads,
                                    const Implicitness& implicitness, std::vector<Vec2>& out) {
  sweepOut(links, bases, state, kinematics, implicitness.products);
  addLoads(loads, implicitness);
  sweepBack(links, state, loads, implicitness);
  settle(links, out);
}

// The wrenches change by half of what the links' bias does; the chain answers as it did before.
void ArticulatedBody::averageProducts(const std::vector<Link>& links,
                                      const std::vector<BaseMotion>& bases, const ChainState& state,
                                      const Kinematics& k, double h, std::vector<Vec2>& out) {
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Link& link = links[i];
    const bool root = link.parent < 0;
    const auto p = static_cast<std::size_t>(root ? 0 : link.parent);
    const BaseMotion& base = baseOf(link, bases);
    const Vec3 parent = root ? base.spin : Vec3(k.spin[p] + h * push_[p].spin);
    const Vec3 spin = k.spin[i] + h * push_[i].spin;
    const Axes axes = axesOf(k.pose[i].orientation);
    const Vec2 rate = state.rate[i] + h * out[i];
    free_[i] =
        freeMotion(root ? accelerationOf(base) : free_[p], parent, spin - parent,
                   bendBias(bendOf(state.q[i]), state.q[i], rate, axes), joints_[i].offset, 1.0);
    const Wrench bias = biasOf(link, axes, spin, free_[i], 1.0);
    bodies_[i].torque = 0.5 * (bias.torque - bias_[i].torque);
    bodies_[i].force = 0.5 * (bias.force - bias_[i].force);
  }
  sweepWrenches(links);
  settle(links, change_);
  for (std::size_t i = 0; i < links.size(); ++i) out[i] += change_[i];
}

void ArticulatedBody::torques(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                              const ChainState& state, const Kinematics& kinematics,
                              const Loads& loads, const std::vector<Vec2>& acceleration,
                              std::vector<Vec2>& out) {
  sweepOut(links, bases, state, kinematics, 1.0);
  addLoads(loads, {});
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Acceleration& parent =
        links[i].parent < 0 ? NONE : push_[static_cast<std::size_t>(links[i].parent)];
    push_[i] = pushed(parent, joints_[i], acceleration[i]);
  }
  out.resize(links.size());
  for (std::size_t i = links.size(); i-- > 0;) {
    const Link& link = links[i];
    Body& body = bodies_[i];
    body.torque += multiply(body.a, push_[i].spin) + timesB(body, push_[i].linear);
    body.force += timesTransposedB(body, push_[i].spin) + multiply(body.m, push_[i].linear);
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
