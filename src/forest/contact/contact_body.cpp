// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/contact/contact_body.h"

#include <cmath>

#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

constexpr std::size_t LONGEST_NAME = 4096;

// Rotation by a vector of angles [rad].
Quat turnBy(const Vec3& turn) {
  const double angle = length(turn);
  if (angle < 1e-9) return normalized({1.0, 0.5 * turn.x(), 0.5 * turn.y(), 0.5 * turn.z()});
  const SinCos half = sinCos(0.5 * angle);
  const double s = half.sin / angle;
  return {half.cos, s * turn.x(), s * turn.y(), s * turn.z()};
}

Vec3 turnOf(Quat q) {
  if (q.w < 0.0) q = {-q.w, -q.x, -q.y, -q.z};
  const Vec3 v(q.x, q.y, q.z);
  const double s = length(v);
  if (s < 1e-12) return 2.0 * v;
  return 2.0 * arcTangent(s, q.w) / s * v;
}

void checkSize(const Body& body, const char* name, double value, double least, Faults& faults) {
  const std::string fault =
      rangeFault("body " + inQuotes(body.id) + "." + name, value, "m", Range{least, LARGEST_BODY});
  if (!fault.empty()) faults.add(fault);
}

void checkShape(const Body& body, Faults& faults) {
  switch (body.shape) {
    case Shape::CAPSULE:
      checkSize(body, "length", body.size.z(), 0.0, faults);
      [[fallthrough]];
    case Shape::SPHERE:
      return checkSize(body, "radius", body.size.x(), SMALLEST_BODY, faults);
    case Shape::BOX:
      checkSize(body, "size_x", body.size.x(), SMALLEST_BODY, faults);
      checkSize(body, "size_y", body.size.y(), SMALLEST_BODY, faults);
      return checkSize(body, "size_z", body.size.z(), SMALLEST_BODY, faults);
  }
  faults.add("body " + inQuotes(body.id) +
             ".shape = " + std::to_string(static_cast<int>(body.shape)) +
             " is none of 0 (sphere), 1 (capsule), 2 (box)");
}

}  // namespace

void check(const Body& body, Faults& faults) {
  if (body.id.empty()) faults.add("body.id is empty");
  checkShape(body, faults);
  Body copy = body;
  const std::string name = "body " + inQuotes(body.id) + ".";
  FieldChecker checker(name, faults);
  checker.vector("position", copy.pose.position, "m", {-1e7, 1e7});
  checker.vector("velocity", copy.velocity, "m/s", {-FASTEST_BODY, FASTEST_BODY});
  checker.vector("spin", copy.spin, "rad/s", {-FASTEST_SPIN, FASTEST_SPIN});
  checker.vector("offset", copy.in_frame.position, "m", {-1e7, 1e7});
  checkOrientation(body.pose.orientation, name + "orientation", faults);
  checkOrientation(body.in_frame.orientation, name + "offset.orientation", faults);
}

void archiveBody(Archive& a, Body& body) {
  a.text("body id", body.id, LONGEST_NAME);
  a.text("body frame", body.frame, LONGEST_NAME);
  a.integer("body shape", body.shape, Shape::SPHERE, Shape::BOX);
  a.vector("body size", body.size);
  a.pose("body pose", body.pose);
  a.vector("body velocity", body.velocity);
  a.vector("body spin", body.spin);
  a.stamp("body stamp", body.stamp);
  a.pose("body in_frame", body.in_frame);
}

void addTo(Hash& hash, const Body& body) {
  hash.add(static_cast<std::uint64_t>(body.shape));
  for (const Vec3& v : {body.size, body.pose.position, body.velocity, body.spin}) hash.add(v);
  const Quat& q = body.pose.orientation;
  for (const double v : {q.w, q.x, q.y, q.z}) hash.add(v);
  hash.add(static_cast<std::uint64_t>(body.stamp));
}

physics::RoundedBox shapeOf(const Body& body) {
  switch (body.shape) {
    case Shape::BOX:
      return {0.5 * body.size, 0.0};
    case Shape::CAPSULE:
      return {Vec3(0.0, 0.0, 0.5 * body.size.z()), body.size.x()};
    case Shape::SPHERE:
      break;
  }
  return {Vec3::Zero(), body.size.x()};
}

Pose poseAt(const Body& body, Nanoseconds stamp) {
  const double after = secondsBetween(body.stamp, stamp);
  return {body.pose.position + after * body.velocity,
          normalized(turnBy(after * body.spin) * body.pose.orientation)};
}

Vec3 velocityAt(const Body& body, const Pose& pose, const Vec3& point) {
  return body.velocity + cross(body.spin, point - pose.position);
}

void setMotion(Body& body, const Pose& from, const Pose& to, double seconds) {
  body.velocity = (to.position - from.position) / seconds;
  body.spin = turnOf(to.orientation * conjugate(from.orientation)) / seconds;
}

}  // namespace vegetation_sim::forest
