// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/conversions/grab_conversions.h"

#include "forest/contact/contact_body.h"
#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr Range POSITIONS{-1e7, 1e7};  // [m]

}  // namespace

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
  Faults faults;
  FieldChecker checker("", faults);
  checker.vector("target", out.target, "m", POSITIONS);
  checker.number("along", out.point.along, "m", {0.0, 1e4});
  checker.number("stiffness", out.stiffness, "N/m", {1.0, 1e6});
  checker.number("damping", out.damping, "N s/m", {0.0, 1e5});
  checker.number("force_limit", out.force_limit, "N", {0.01, 1e5});
  checker.number("lease", out.lease, "s", {0.1, 3600.0});
  faults.throwIfAny();
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
  out.holder.orientation.w = 1.0;
  return out;
}

forest::Push fromMsg(const BranchForce& message, Nanoseconds start) {
  forest::Push out;
  out.point = {message.tree, static_cast<int>(message.branch), message.along};
  out.force = fromMsg(message.force);
  double duration = message.duration;
  Faults faults;
  FieldChecker checker("", faults);
  checker.vector("force", out.force, "N", {-1e5, 1e5});
  checker.number("along", out.point.along, "m", {0.0, 1e4});
  checker.number("duration", duration, "s", {0.001, 3600.0});
  faults.throwIfAny();
  out.from = start;
  out.until = start + fromSeconds(duration);
  return out;
}

forest::Body fromMsg(const ForestBody& message) {
  forest::Body out;
  out.id = message.id;
  out.frame = message.frame;
  out.shape = message.shape;
  out.size = fromMsg(message.size);
  out.pose = fromMsg(message.pose);
  out.velocity = fromMsg(message.twist.linear);
  out.spin = fromMsg(message.twist.angular);
  out.stamp = fromMsg(message.stamp);
  Faults faults;
  forest::check(out, faults);
  faults.throwIfAny();
  return out;
}

ForestBody toMsg(const forest::Body& body, const Pose& in_frame) {
  ForestBody out;
  out.id = body.id;
  out.frame = body.frame;
  out.shape = static_cast<std::uint8_t>(body.shape);
  out.size = toVector(body.size);
  out.offset = toMsg(in_frame);
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

}  // namespace vegetation_sim
