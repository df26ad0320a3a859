// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/conversions/optional_numbers.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {

GrassCut toMsg(const grass::CutArea& area) {
  GrassCut out;
  for (const grass::Point& p : area.outline) out.outline.push_back(toPoint(Vec3(p.x, p.y, 0.0)));
  for (const grass::Point& p : area.swath) out.swath.push_back(toPoint(Vec3(p.x, p.y, 0.0)));
  out.radius = area.radius;
  out.height = area.height;
  return out;
}

grass::CutArea fromMsg(const GrassCut& message, const std::string& context) {
  grass::CutArea out;
  for (const geometry_msgs::Point& p : message.outline) out.outline.push_back({p.x, p.y});
  for (const geometry_msgs::Point& p : message.swath) out.swath.push_back({p.x, p.y});
  out.radius = message.radius;
  out.height = message.height;
  Faults faults;
  check(out, context, faults);
  faults.throwIfAny();
  return out;
}

TreadLaw toMsg(const grass::TreadLaw& law) {
  TreadLaw out;
  out.has_radius = out.has_reach = out.has_softness = out.has_load = out.has_recovery = true;
  out.radius = law.radius;
  out.reach = law.reach;
  out.softness = law.softness;
  out.load = law.load;
  out.recovery = law.recovery;
  return out;
}

grass::TreadLaw fromMsg(const TreadLaw& message, const grass::TreadLaw& own,
                        const std::string& context, Faults& faults) {
  OptionalNumbers numbers(context, faults);
  grass::TreadLaw out = own;
  // A radius out of range is the only fault in the error, without the numbers that follow from it.
  if (numbers.read("radius", message.has_radius, message.radius, out.radius) &&
      grass::TREAD_RADIUS.contains(message.radius)) {
    out.reach = own.reach * (message.radius / own.radius);
    out.softness = own.softness * (message.radius / own.radius);
  }
  numbers.read("reach", message.has_reach, message.reach, out.reach);
  numbers.read("softness", message.has_softness, message.softness, out.softness);
  numbers.read("load", message.has_load, message.load, out.load);
  numbers.read("recovery", message.has_recovery, message.recovery, out.recovery);
  return out;
}

TreadEvent toMsg(const grass::TreadInput& input) {
  TreadEvent out;
  out.source = input.source;
  out.action = static_cast<std::uint8_t>(input.action);
  out.start = toPoint(input.start);
  out.position = toPoint(input.position);
  out.has_height_gate = true;
  out.height_gate = input.height_gate;
  out.has_velocity = input.velocity.has_value();
  out.velocity = toVector(input.velocity.value_or(Vec3::Zero()));
  out.law = toMsg(input.law);
  out.body_frame = input.body_frame;
  return out;
}

grass::TreadInput fromMsg(const TreadEvent& message, const grass::TreadLaw& own,
                          double height_gate) {
  grass::TreadInput out;
  out.source = message.source;
  out.action = static_cast<grass::TreadAction>(message.action);
  if (out.action != grass::TreadAction::LIFT) {  // it has no place
    out.start = fromMsg(message.start);
    out.position = fromMsg(message.position);
  }
  out.body_frame = message.body_frame;
  Faults faults;
  out.height_gate = height_gate;
  OptionalNumbers("tread: ", faults)
      .read("height_gate", message.has_height_gate, message.height_gate, out.height_gate);
  const Vec3 velocity = fromMsg(message.velocity);
  if (message.has_velocity)
    out.velocity = velocity;
  else if (!(velocity == Vec3::Zero()))
    faults.add("tread: velocity needs has_velocity = true");
  out.law = fromMsg(message.law, own, "tread: ", faults);
  check(out, "tread: ", faults);
  faults.throwIfAny();
  return out;
}

GrassColours toMsg(const grass::ColourMasks& masks) {
  GrassColours out;
  out.header.stamp = toStamp(masks.stamp);
  for (const grass::ColourMask& mask : masks.list) {
    GrassColour colour;
    colour.x = mask.centre.x;
    colour.y = mask.centre.y;
    colour.radius = mask.radius;
    colour.colour = mask.colour;
    colour.weight = mask.weight;
    colour.velocity_x = mask.velocity.x;
    colour.velocity_y = mask.velocity.y;
    out.colours.push_back(colour);
  }
  return out;
}

grass::ColourMasks fromMsg(const GrassColours& message) {
  return masksOf(message.colours, fromMsg(message.header.stamp));
}

grass::ColourMasks masksOf(const std::vector<GrassColour>& discs, Nanoseconds stamp) {
  grass::ColourMasks out;
  out.stamp = stamp;
  for (const GrassColour& c : discs)
    out.list.push_back({{c.x, c.y}, c.radius, c.colour, c.weight, {c.velocity_x, c.velocity_y}});
  Faults faults;
  check(out, faults);
  faults.throwIfAny();
  return out;
}

}  // namespace vegetation_sim
