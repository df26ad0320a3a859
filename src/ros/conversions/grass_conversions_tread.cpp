// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"

namespace vegetation_sim {

TreadLaw toMsg(const grass::TreadLaw& law) {
  TreadLaw out;
  out.radius = law.radius;
  out.reach = law.reach;
  out.softness = law.softness;
  out.load = law.load;
  out.recovery = law.recovery;
  return out;
}

grass::TreadLaw fromMsg(const TreadLaw& message, const grass::TreadLaw& own) {
  grass::TreadLaw out = own;
  if (message.radius != 0.0) {
    const double size = message.radius / own.radius;
    out.radius = message.radius;
    out.reach = own.reach * size;
    out.softness = own.softness * size;
  }
  if (message.reach != 0.0) out.reach = message.reach;
  if (message.softness != 0.0) out.softness = message.softness;
  if (message.load != 0.0) out.load = message.load;
  if (message.recovery != 0.0) out.recovery = message.recovery;
  return out;
}

TreadEvent toMsg(const grass::TreadInput& input) {
  TreadEvent out;
  out.source = input.source;
  out.action = static_cast<std::uint8_t>(input.action);
  out.start = toPoint(input.start);
  out.position = toPoint(input.position);
  out.height_gate = input.height_gate;
  out.velocity = toVector(input.velocity);
  out.law = toMsg(input.law);
  out.body_frame = input.body_frame;
  return out;
}

grass::TreadInput fromMsg(const TreadEvent& message, const grass::TreadLaw& own,
                          double height_gate) {
  grass::TreadInput out;
  out.source = message.source;
  out.action = static_cast<grass::TreadAction>(message.action);
  out.start = fromMsg(message.start);
  out.position = fromMsg(message.position);
  out.height_gate = message.height_gate != 0.0 ? message.height_gate : height_gate;
  out.velocity = fromMsg(message.velocity);
  out.law = fromMsg(message.law, own);
  out.body_frame = message.body_frame;
  Faults faults;
  check(out, "tread: ", faults);
  faults.throwIfAny();
  return out;
}

}  // namespace vegetation_sim
