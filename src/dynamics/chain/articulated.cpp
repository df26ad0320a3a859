// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/chain/articulated.h"

#include "dynamics/chain/articulated_body.h"

namespace vegetation_sim::physics {
namespace {

// Returns what the rates add to the change of a link's spin; `spin` is that of its parent.
Vec3 biasOf(const ArticulatedBody::Joint& joint, const ChainState& state, std::size_t i,
            const Vec3& spin, const Vec3& own) {
  return bendBias(joint.bend, state.q[i], state.rate[i], joint.axes) + cross(spin, own - spin);
}

}  // namespace

void ArticulatedBody::updateKinematics(const std::vector<Link>& links,
                                       const std::vector<BaseMotion>& bases,
                                       const ChainState& state, Kinematics& out) {
  const std::size_t n = links.size();
  joints_.resize(n);
  out.pose.resize(n);
  out.spin.resize(n);
  out.velocity.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Link& link = links[i];
    const bool root = link.parent < 0;
    const auto p = static_cast<std::size_t>(root ? 0 : link.parent);
    const BaseMotion& base = baseOf(link, bases);
    const Pose& from = root ? base.pose : out.pose[p];
    const Vec3 spin = root ? base.spin : out.spin[p];
    const Vec2 &q = state.q[i], &rate = state.rate[i];
    Joint& joint = joints_[i];
    joint.bend = bendOf(q);
    joint.offset = link.h * (root ? axisZ(from.orientation) : joints_[p].axes.z);
    Pose& pose = out.pose[i];
    pose.position = from.position + joint.offset;
    pose.orientation = from.orientation * (link.rest * rotationOf(joint.bend, q));
    joint.axes = axesOf(pose.orientation);
    bendAxes(joint.bend, q, joint.axes, joint.first, joint.second);
    out.spin[i] = spin + rate.x() * joint.first + rate.y() * joint.second;
    joint.sweep = cross(out.spin[i], joint.axes.z);
    out.velocity[i] = root ? Vec3(base.velocity + cross(spin, joint.offset))
                           : Vec3(out.velocity[p] + link.h * joints_[p].sweep);
  }
}

void ArticulatedBody::turnOut(const Links& links, const Bases& bases, const ChainState& state,
                              const Kinematics& k) {
  joints_.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    const bool root = links[i].parent < 0;
    const auto p = static_cast<std::size_t>(root ? 0 : links[i].parent);
    Joint& joint = joints_[i];
    joint.bend = bendOf(state.q[i]);
    joint.axes = axesOf(k.pose[i].orientation);
    bendAxes(joint.bend, state.q[i], joint.axes, joint.first, joint.second);
    joint.sweep = cross(k.spin[i], joint.axes.z);
    joint.offset =
        links[i].h * (root ? axisZ(baseOf(links[i], bases).pose.orientation) : joints_[p].axes.z);
  }
}

void ArticulatedBody::sweepOut(const Links& links, const Bases& bases, const ChainState& state,
                               const Kinematics& k, double products) {
  const std::size_t n = links.size();
  bodies_.resize(n);
  free_.resize(n);
  push_.resize(n);
  bias_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Link& link = links[i];
    const bool root = link.parent < 0;
    const auto p = static_cast<std::size_t>(root ? 0 : link.parent);
    const Vec3& spin = root ? baseOf(link, bases).spin : k.spin[p];
    const Joint& joint = joints_[i];
    const Axes& axes = joint.axes;
    const Vec3 change = biasOf(joint, state, i, spin, k.spin[i]);
    FreeMotion ground;
    if (root) ground = freeMotionOf(baseOf(link, bases), products);
    freeMotion(root ? ground : free_[p], link.h, change, k.spin[i], joint.sweep, axes.z, products,
               free_[i]);
    rigidBody(link, axes, bodies_[i]);
    bias_[i] = biasOf(link, axes, k.spin[i], joint.sweep, free_[i], products);
    bodies_[i].torque = bias_[i].torque;
    bodies_[i].force = bias_[i].force;
  }
}

// An implicit spring resists the motion that accelerations of the joints add, like a mass. The
// motion of the links without them is part of the predicted pose already.
void ArticulatedBody::addLoads(const Loads& loads, const Implicitness& implicitness) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    bodies_[i].torque -= loads.wrench[i].torque;
    bodies_[i].force -= loads.wrench[i].force;
  }
  if (implicitness.damping > 0.0)
    for (std::size_t i = 0; i < loads.drag.size(); ++i)
      addDrag(implicitness.damping, loads.drag[i], bodies_[i]);
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
    const double predicted = implicitness.predicted(link);
    gain.a1 = multiply(body.a, joint.first);
    gain.b1 = timesTransposedB(body, joint.first);
    gain.a2 = multiply(body.a, joint.second);
    gain.b2 = timesTransposedB(body, joint.second);
    const double pivot1 = dot(joint.first, gain.a1) + predicted;
    gain.inverse1 = 1.0 / pivot1;
    const double across = dot(joint.first, gain.a2);
    gain.coupling = across * gain.inverse1;
    const double pivot2 = dot(joint.second, gain.a2) + predicted - gain.coupling * across;
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
    Body passed = body;
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
  turnOut(links, bases, state, kinematics);
  solve(links, bases, state, kinematics, loads, implicitness, out);
}

void ArticulatedBody::solve(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                            const ChainState& state, const Kinematics& kinematics,
                            const Loads& loads, const Implicitness& implicitness,
                            std::vector<Vec2>& out) {
  sweepOut(links, bases, state, kinematics, implicitness.products);
  addLoads(loads, implicitness);
  sweepBack(links, state, loads, implicitness);
  settle(links, out);
}

namespace {

// Each joint bears the wrenches of its link and of all links beyond.
void sumTorques(const std::vector<Link>& links, const std::vector<ArticulatedBody::Joint>& joints,
                const ChainState& state, std::vector<Wrench>& bias, std::vector<Vec2>& out) {
  out.resize(links.size());
  for (std::size_t i = links.size(); i-- > 0;) {
    const Link& link = links[i];
    const Wrench& wrench = bias[i];
    const Vec2 &q = state.q[i], &rate = state.rate[i];
    out[i] = Vec2(
        dot(joints[i].first, wrench.torque) + link.stiffness * q.x() + link.damping * rate.x(),
        dot(joints[i].second, wrench.torque) + link.stiffness * q.y() + link.damping * rate.y());
    if (link.parent < 0) continue;
    Wrench& parent = bias[static_cast<std::size_t>(link.parent)];
    parent.torque += wrench.torque + cross(joints[i].offset, wrench.force);
    parent.force += wrench.force;
  }
}

}  // namespace

void ArticulatedBody::torques(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                              const ChainState& state, const Kinematics& kinematics,
                              const Loads& loads, const std::vector<Vec2>& acceleration,
                              std::vector<Vec2>& out) {
  turnOut(links, bases, state, kinematics);
  const std::size_t n = links.size();
  free_.resize(n);
  bias_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Link& link = links[i];
    const bool root = link.parent < 0;
    const auto p = static_cast<std::size_t>(root ? 0 : link.parent);
    const Vec3 &own = kinematics.spin[i],
               &spin = root ? baseOf(link, bases).spin : kinematics.spin[p];
    const Joint& joint = joints_[i];
    const Vec3 change = biasOf(joint, state, i, spin, own) + acceleration[i].x() * joint.first +
                        acceleration[i].y() * joint.second;
    FreeMotion ground;
    if (root) ground = freeMotionOf(baseOf(link, bases), 1.0);
    freeMotion(root ? ground : free_[p], link.h, change, own, joint.sweep, joint.axes.z, 1.0,
               free_[i]);
    bias_[i] = biasOf(link, joint.axes, own, joint.sweep, free_[i], 1.0);
    bias_[i].torque -= loads.wrench[i].torque;
    bias_[i].force -= loads.wrench[i].force;
  }
  for (const Anchor& anchor : loads.anchors) {
    Wrench& wrench = bias_[static_cast<std::size_t>(anchor.link)];
    wrench.torque -= cross(anchor.arm, anchor.force);
    wrench.force -= anchor.force;
  }
  sumTorques(links, joints_, state, bias_, out);
}

}  // namespace vegetation_sim::physics
