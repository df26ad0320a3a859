// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/conversions/grab_conversions.h"

#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {

forest::Grab fromMsg(const BranchGrab& message) {
  forest::Grab out;
  out.id = message.id;
  out.point = {message.tree, static_cast<int>(message.branch), message.along};
  out.target = fromMsg(message.target);
  out.stiffness = message.stiffness;
  out.damping = message.damping;
  out.force_limit = message.force_limit;
  out.lease = message.lease;
  out.frame = message.frame;
  out.offset = fromMsg(message.offset);
  out.holder = fromMsg(message.holder);
  out.jaw_length = message.jaw_length;
  if (out.jaw_length != 0.0) out.direction = fromMsg(message.direction);
  return out;
}

BranchGrab toMsg(const forest::Grab& grab) {
  BranchGrab out;
  out.id = grab.id;
  out.tree = grab.point.tree;
  out.branch = static_cast<std::uint32_t>(grab.point.branch);
  out.along = grab.point.along;
  out.target = toPoint(grab.target);
  out.stiffness = grab.stiffness;
  out.damping = grab.damping;
  out.force_limit = grab.force_limit;
  out.lease = grab.lease;
  out.frame = grab.frame;
  out.offset = toPoint(grab.offset);
  out.holder = toMsg(grab.holder);
  out.jaw_length = grab.jaw_length;
  out.direction = toVector(grab.direction);
  return out;
}

forest::Push fromMsg(const BranchForce& message) {
  forest::Push out;
  out.point = {message.tree, static_cast<int>(message.branch), message.along};
  out.force = fromMsg(message.force);
  double duration = message.duration;
  Faults faults;
  FieldChecker("", faults).number("duration", duration, "s", {0.001, 3600.0});
  faults.throwIfAny();
  out.until = fromSeconds(duration);
  out.whole_tree = message.whole_tree;
  return out;
}

BranchForce toMsg(const forest::Push& push) {
  BranchForce out;
  out.tree = push.point.tree;
  out.branch = static_cast<std::uint32_t>(push.point.branch);
  out.along = push.point.along;
  out.force = toVector(push.force);
  out.duration = secondsBetween(push.from, push.until);
  out.whole_tree = push.whole_tree;
  return out;
}

forest::Body fromMsg(const ForestBody& message) {
  forest::Body out;
  out.id = message.id;
  out.frame = message.frame;
  out.shape = static_cast<forest::Shape>(message.shape);
  out.size = fromMsg(message.size);
  out.pose = fromMsg(message.pose);
  out.velocity = fromMsg(message.twist.linear);
  out.spin = fromMsg(message.twist.angular);
  out.stamp = fromMsg(message.stamp);
  out.in_frame = fromMsg(message.offset);
  return out;
}

ForestBody toMsg(const forest::Body& body) {
  ForestBody out;
  out.id = body.id;
  out.frame = body.frame;
  out.shape = static_cast<std::uint8_t>(body.shape);
  out.size = toVector(body.size);
  out.offset = toMsg(body.in_frame);
  out.pose = toMsg(body.pose);
  out.twist.linear = toVector(body.velocity);
  out.twist.angular = toVector(body.spin);
  out.stamp = toStamp(body.stamp);
  return out;
}

FramedWrench wrenchIn(const Pose& frame, const forest::Reaction& reaction) {
  const Quat back = conjugate(frame.orientation);
  const Vec3 lever = reaction.point - frame.position;
  return {rotate(back, reaction.force),
          rotate(back, reaction.torque + cross(lever, reaction.force))};
}

ContactForce toMsg(const forest::Reaction& reaction, const Pose& frame) {
  const FramedWrench wrench = wrenchIn(frame, reaction);
  ContactForce out;
  out.grab = reaction.grab;
  out.body = reaction.body;
  out.tree = reaction.at.tree;
  out.branch = static_cast<std::uint32_t>(reaction.at.branch);
  out.along = reaction.at.along;
  out.point = toPoint(reaction.point);
  out.force = toVector(reaction.force);
  out.frame = reaction.frame;
  out.wrench.force = toVector(wrench.force);
  out.wrench.torque = toVector(wrench.torque);
  out.limited = reaction.limited;
  out.penetration = reaction.penetration;
  return out;
}

PlantContact toMsg(const canopy::PushForce& force, const Pose& frame) {
  forest::Reaction reaction;
  reaction.point = force.point;
  reaction.force = force.force;
  reaction.torque = force.torque;
  const FramedWrench wrench = wrenchIn(frame, reaction);
  PlantContact out;
  out.body = force.body;
  out.plant = force.plant;
  out.point = toPoint(force.point);
  out.force = toVector(force.force);
  out.frame = force.frame;
  out.wrench.force = toVector(wrench.force);
  out.wrench.torque = toVector(wrench.torque);
  out.overlap = force.volume;
  return out;
}

BrokenBranch toMsg(const forest::BrokenBranch& broken) {
  BrokenBranch out;
  out.branch = static_cast<std::uint32_t>(broken.branch);
  out.stamp = toStamp(broken.stamp);
  out.cut = broken.cut;
  out.pose = toMsg(broken.pose);
  out.twist.linear = toVector(broken.velocity);
  out.twist.angular = toVector(broken.spin);
  return out;
}

forest::BrokenBranch fromMsg(const BrokenBranch& message) {
  forest::BrokenBranch out;
  out.branch = static_cast<int>(message.branch);
  out.stamp = fromMsg(message.stamp);
  out.cut = message.cut != 0;
  out.pose = fromMsg(message.pose);
  out.velocity = fromMsg(message.twist.linear);
  out.spin = fromMsg(message.twist.angular);
  return out;
}

BranchBreak toMsg(const forest::Break& broken) {
  BranchBreak out;
  out.header.stamp = toStamp(broken.piece.stamp);
  out.tree = broken.tree;
  out.piece = toMsg(broken.piece);
  out.stress = broken.stress;
  out.mass = broken.mass;
  out.grabs = broken.grabs;
  return out;
}

}  // namespace vegetation_sim
