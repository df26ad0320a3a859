// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/ros/conversions/wind_conversions.h"

#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

/// Visits the numbers that message and primitive share, so that both directions list them once.
template <class Message, class Primitive, class Visit>
void visitNumbers(Message& message, Primitive& p, Visit visit) {
  visit(message.fade_in, p.fade_in);
  visit(message.fade_out, p.fade_out);
  visit(message.orbit_radius, p.orbit_radius);
  visit(message.orbit_period, p.orbit_period);
  visit(message.repeat, p.repeat);
  visit(message.velocity.x, p.velocity.x());
  visit(message.velocity.y, p.velocity.y());
  visit(message.velocity.z, p.velocity.z());
  visit(message.radius, p.radius);
  visit(message.omega, p.omega);
  visit(message.phase, p.phase);
  visit(message.turbulence, p.turbulence);
  visit(message.length_scale, p.length_scale);
  visit(message.time_scale, p.time_scale);
  visit(message.front_speed, p.front_speed);
  visit(message.rise_length, p.rise_length);
  visit(message.plateau_length, p.plateau_length);
  visit(message.decay_length, p.decay_length);
  visit(message.speed, p.speed);
  visit(message.core_radius, p.core_radius);
  visit(message.inflow, p.inflow);
  visit(message.updraft, p.updraft);
}

}  // namespace

WindPrimitive toMsg(const wind::Primitive& p) {
  WindPrimitive message;
  visitNumbers(message, p, [](double& to, const double& from) { to = from; });
  message.id = p.id;
  message.name = p.name;
  message.kind = static_cast<std::uint8_t>(p.kind);
  message.envelope = static_cast<std::uint8_t>(p.envelope);
  message.epoch = toStamp(p.epoch);
  message.t_on = toStamp(p.t_on);
  message.t_off = toStamp(p.t_off);
  for (const wind::Waypoint& point : p.trajectory) {
    geometry_msgs::PointStamped stamped;
    stamped.header.stamp = toStamp(point.stamp);
    stamped.point.x = point.position.x();
    stamped.point.y = point.position.y();
    stamped.point.z = point.position.z();
    message.trajectory.push_back(stamped);
  }
  return message;
}

wind::Primitive fromMsg(const WindPrimitive& message) {
  wind::Primitive p;
  visitNumbers(message, p, [](const double& from, double& to) { to = from; });
  p.id = message.id;
  p.name = message.name;
  p.kind = static_cast<wind::Kind>(message.kind);
  p.envelope = static_cast<wind::Envelope>(message.envelope);
  p.epoch = fromMsg(message.epoch);
  p.t_on = fromMsg(message.t_on);
  p.t_off = fromMsg(message.t_off);
  for (const auto& point : message.trajectory)
    p.trajectory.push_back(
        {fromMsg(point.header.stamp), Vec3(point.point.x, point.point.y, point.point.z)});
  return p;
}

wind::Source sourceFromMsg(const WindPrimitive& message, const std::string& frame_id,
                           Faults& faults) {
  for (std::size_t i = 0; i < message.trajectory.size(); ++i) {
    const std::string& frame = message.trajectory[i].header.frame_id;
    if (!frame.empty() && frame != frame_id)
      faults.add("primitive " + inQuotes(message.name) + ": trajectory[" + std::to_string(i) +
                 "].header.frame_id = " + inQuotes(frame) + " is not " + inQuotes(frame_id) +
                 " or empty");
  }
  return {fromMsg(message), message.attached_frame};
}

WindField toMsg(const wind::Field& field, const std::string& frame_id, Nanoseconds stamp) {
  WindField message;
  message.header.stamp = toStamp(stamp);
  message.header.frame_id = frame_id;
  message.seed = field.seed();
  message.hash = field.hash();
  for (const wind::Primitive& p : field.primitives()) message.primitives.push_back(toMsg(p));
  return message;
}

wind::Field fromMsg(const WindField& message) {
  std::vector<wind::Primitive> primitives;
  for (const WindPrimitive& primitive : message.primitives)
    primitives.push_back(fromMsg(primitive));
  wind::Field field(std::move(primitives), message.seed);
  if (field.hash() != message.hash)
    throw InvalidInput("wind: hash = " + std::to_string(message.hash) + " is not " +
                       std::to_string(field.hash()) +
                       " of the same primitives here; is the sender of another version?");
  return field;
}

}  // namespace vegetation_sim
