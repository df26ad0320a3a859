// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/forest/forest_inputs.h"

#include <algorithm>

#include "core/config/field_values.h"
#include "ros/conversions/grab_conversions.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"

namespace vegetation_sim {
namespace {

bool isInteraction(const ForestInput& input) {
  return (input.kind >= ForestInput::GRAB && input.kind <= ForestInput::RENEW) ||
         input.kind == ForestInput::CUT;
}

// Whether `input` makes the waiting input void.
bool replaces(const ForestInput& input, const ForestInput& waiting) {
  if (input.kind != waiting.kind) return false;
  if (input.kind == ForestInput::SENSOR)
    return input.stamp == waiting.stamp && input.sensor.id == waiting.sensor.id;
  if (!isInteraction(input)) return true;
  return (input.kind == ForestInput::MOVE || input.kind == ForestInput::RENEW) &&
         input.stamp == waiting.stamp && input.grab.id == waiting.grab.id;
}

}  // namespace

void describe(FieldVisitor& v, ForestTuning& t) {
  describe(v, t.settings);
  describe(v, t.design);
  v.number("transition", t.transition, "s", {0.01, 60.0});
}

ForestEvent eventToMsg(const ForestInput& input) {
  ForestEvent out;
  out.kind = input.kind;
  out.header.stamp = toStamp(input.stamp);
  out.wind_hash = input.wind_hash;
  out.names = input.names;
  out.values = input.values;
  switch (input.kind) {
    case ForestInput::SENSOR:
      out.sensor = toMsg(input.sensor);
      break;
    case ForestInput::GRAB:
      out.grab = toMsg(input.grab);
      break;
    case ForestInput::MOVE:
      out.grab.target = toPoint(input.grab.target);
      out.grab.holder = toMsg(input.grab.holder);
      [[fallthrough]];
    case ForestInput::RELEASE:
    case ForestInput::RENEW:
      out.grab.id = input.grab.id;
      break;
    case ForestInput::FORCE:
      out.force = toMsg(input.push);
      break;
    case ForestInput::BODY:
      out.body = toMsg(input.body);
      break;
    case ForestInput::REMOVE_BODY:
      out.body.id = input.body.id;
      break;
    case ForestInput::LOAD:
      out.snapshot = input.snapshot;
      break;
    case ForestInput::CUT:
      out.cut.tree = input.cut.tree;
      out.cut.branch = static_cast<std::uint32_t>(input.cut.branch);
      break;
    default:
      break;
  }
  return out;
}

ForestInput eventFromMsg(const ForestEvent& message) {
  ForestInput out;
  out.kind = message.kind;
  out.stamp = fromMsg(message.header.stamp);
  out.wind_hash = message.wind_hash;
  out.names = message.names;
  out.values = message.values;
  out.grab = fromMsg(message.grab);
  if (message.kind == ForestEvent::SENSOR) out.sensor = fromMsg(message.sensor);
  if (message.kind == ForestEvent::FORCE) out.push = fromMsg(message.force);
  out.body = fromMsg(message.body);
  out.snapshot = message.snapshot;
  out.cut = {message.cut.tree, static_cast<int>(message.cut.branch)};
  return out;
}

void applyInteraction(const ForestInput& input, forest::Forest& forest) {
  switch (input.kind) {
    case ForestInput::GRAB:
      forest.addGrab(input.grab);
      break;
    case ForestInput::MOVE:
      forest.moveGrab(input.grab.id, input.grab.target, input.grab.holder);
      break;
    case ForestInput::RENEW:
      forest.renewGrab(input.grab.id);
      break;
    case ForestInput::RELEASE:
      forest.release(input.grab.id);
      break;
    case ForestInput::FORCE:
      forest.push({input.push.point, input.push.force, input.stamp + input.push.until, input.stamp,
                   input.push.whole_tree});
      break;
    case ForestInput::CUT:
      forest.cut(input.cut);
      break;
    case ForestInput::BODY:
      forest.setBody(input.body);
      break;
    case ForestInput::REMOVE_BODY:
      forest.removeBody(input.body.id);
      break;
    default:
      throw InvalidInput("kind = " + std::to_string(input.kind) + " is outside 0 to 12");
  }
}

ForestTuning tuningOf(const ForestInput& input) {
  return fromNamedValues<ForestTuning>({input.names, input.values});
}

bool ForestInputs::add(const ForestInput& input) {
  if (replay_) return true;
  for (Waiting& waiting : waiting_)
    if (replaces(input, waiting.event)) {
      waiting.event = input;
      report(input);
      return true;
    }
  const bool bounded = isInteraction(input) || input.kind == ForestInput::SENSOR;
  if (bounded && room(input.stamp) == 0) {
    losses_.lost += input.kind == ForestInput::SENSOR;  // a request gets an error instead
    return false;
  }
  push(input);
  return true;
}

const forest::Grab* ForestInputs::waitingGrab(std::uint32_t id) const {
  for (const Waiting& one : waiting_)
    if (one.event.kind == ForestInput::GRAB && one.event.grab.id == id) return &one.event.grab;
  return nullptr;
}

void ForestInputs::forgetGrab(std::uint32_t id) {
  forget([&](const ForestInput& input) { return input.grab.id == id; });  // 0 in all other kinds
}

}  // namespace vegetation_sim
