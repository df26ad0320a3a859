// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/ros/conversions/canopy_conversions.h"

#include <cmath>
#include <utility>

#include "ros/conversions/orientation.h"
#include "ros/params/plant_files.h"
#include "ros/params/resources.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr Range ANYWHERE{-1e7, 1e7};
constexpr std::uint16_t HALF_INFINITY = 0x7c00U;  // exponents from here on are no numbers

bool isFinite(const std::vector<std::uint16_t>& halfs) {
  for (const std::uint16_t half : halfs)
    if ((half & HALF_INFINITY) == HALF_INFINITY) return false;
  return true;
}

}  // namespace

CanopyLayout toMsg(const canopy::Layout& layout) {
  CanopyLayout out;
  out.hash = layout.hash();
  out.seed = layout.seed;
  out.law = canopy::writeLaw(layout);
  for (const canopy::Plant& plant : layout.plants) {
    CanopyPlant message;
    message.seed = plant.seed;
    message.kind = plant.kind;
    message.position = toPoint(plant.position);
    message.yaw = plant.yaw;
    message.scale = plant.scale;
    out.plants.push_back(message);
  }
  return out;
}

canopy::Layout fromMsg(const CanopyLayout& message, const std::vector<std::string>& folders) {
  canopy::Layout out = canopy::parseLaw(message.law, "layout");
  out.seed = message.seed;
  for (const CanopyPlant& plant : message.plants)
    out.plants.push_back({plant.seed, plant.kind, fromMsg(plant.position), plant.yaw, plant.scale});
  Faults faults;
  loadPublishedForms(out, folders, faults);
  canopy::check(out, faults);
  if (faults.empty() && out.hash() != message.hash)
    faults.add("layout: its hash is " + std::to_string(out.hash()) + ", the sender's " +
               std::to_string(message.hash));
  faults.throwIfAny();
  return out;
}

canopy::CutView eyeFromMsg(const geometry_msgs::Pose& pose) {
  Faults faults;
  Vec3 place = fromMsg(pose.position);
  FieldChecker checker("eye: ", faults);
  checker.vector("position", place, "m", ANYWHERE);
  const Quat orientation = orientationOf(pose.orientation, "eye: orientation", faults);
  faults.throwIfAny();
  return {place, orientation};
}

geometry_msgs::Pose eyeToMsg(const canopy::CutView& eye) {
  Pose pose;
  pose.position = eye.position;
  pose.orientation = eye.orientation;
  return toMsg(pose);
}

CanopyState toMsg(const canopy::StateUpdate& update) {
  CanopyState out;
  out.header.stamp = toStamp(update.stamp);
  out.sequence = update.sequence;
  out.right = update.frame.u;
  out.up = update.frame.v;
  out.depth = update.frame.depth;
  out.front_share = update.front_share;
  out.eye = eyeToMsg(update.cuts.now);
  out.eye_before = eyeToMsg(update.cuts.before);
  out.eye_since = toStamp(update.cuts.since);
  for (const canopy::BentCell& bent : update.bent) {
    out.bent_plants.push_back(bent.plant);
    out.bent_cells.push_back(bent.cell);
    out.lean_x.push_back(bent.x);
    out.lean_y.push_back(bent.y);
  }
  out.lists_cuts = update.stubble.has_value();
  if (update.stubble)
    for (const auto& [plant, height] : *update.stubble) {
      out.cut_plants.push_back(plant);
      out.cut_heights.push_back(height);
    }
  out.layout_hash = update.layout_hash;
  out.wind_hash = update.wind_hash;
  out.hash = update.hash;
  return out;
}

canopy::Layout fromMsg(const CanopyLayout& message) {
  return fromMsg(message, resourceFolders());
}

canopy::StateUpdate fromMsg(const CanopyState& message) {
  canopy::StateUpdate out;
  out.stamp = fromMsg(message.header.stamp);
  out.sequence = message.sequence;
  out.frame = {message.right, message.up, message.depth};
  Faults faults;
  if (!isFinite(out.frame.u) || !isFinite(out.frame.v) || !isFinite({out.frame.depth}))
    faults.add("state: a motion is not finite");
  const std::size_t count = message.bent_plants.size();
  for (const auto& [name, size] : {std::make_pair("bent_cells", message.bent_cells.size()),
                                   std::make_pair("lean_x", message.lean_x.size()),
                                   std::make_pair("lean_y", message.lean_y.size())})
    if (size != count)
      faults.add(std::string("state: ") + name + " has " + std::to_string(size) +
                 " entries, bent_plants has " + std::to_string(count));
  if (message.cut_heights.size() != message.cut_plants.size())
    faults.add("state: cut_heights has " + std::to_string(message.cut_heights.size()) +
               " entries, cut_plants has " + std::to_string(message.cut_plants.size()));
  if (message.cut_plants.size() > canopy::MOST_PLANTS)
    faults.add("state: cut_plants has " + std::to_string(message.cut_plants.size()) +
               " entries, allowed are " + std::to_string(canopy::MOST_PLANTS));
  const std::string fault = rangeFault("state: front_share", message.front_share, "", {0.0, 1.0});
  if (!fault.empty()) faults.add(fault);
  faults.throwIfAny();
  out.front_share = message.front_share;
  out.cuts = {eyeFromMsg(message.eye), eyeFromMsg(message.eye_before), fromMsg(message.eye_since)};
  for (std::size_t i = 0; i < count; ++i)
    out.bent.push_back(
        {message.bent_plants[i], message.bent_cells[i], message.lean_x[i], message.lean_y[i]});
  if (message.lists_cuts) {
    out.stubble.emplace();
    for (std::size_t i = 0; i < message.cut_plants.size(); ++i)
      (*out.stubble)[message.cut_plants[i]] = message.cut_heights[i];
  }
  out.layout_hash = message.layout_hash;
  out.wind_hash = message.wind_hash;
  out.hash = message.hash;
  return out;
}

}  // namespace vegetation_sim
