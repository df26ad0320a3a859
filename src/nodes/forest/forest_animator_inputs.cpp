// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/config/field_values.h"
#include "nodes/forest/forest_animator.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim {
namespace {

ForestTuning fromConfig(const ForestAnimatorConfig& config) {
  ForestTuning out;
  out.settings = {config.tolerance,       config.fixed_level, config.highest_level,
                  config.robot_tolerance, config.robot_range, {}};
  out.settings.budget = {config.frame_time, config.state_bytes,     config.modal_trees,
                         config.tree_cost,  config.procedural_cost, config.modal_cost,
                         config.fine_cost,  config.physical_cost};
  out.design = {config.size, config.children, config.leaves, config.angle, config.noise};
  out.transition = config.transition;
  return out;
}

void toConfig(const ForestTuning& tuning, ForestAnimatorConfig& config) {
  const forest::Settings& settings = tuning.settings;
  config.tolerance = settings.tolerance;
  config.fixed_level = settings.fixed_level;
  config.highest_level = settings.highest_level;
  config.robot_tolerance = settings.robot_tolerance;
  config.robot_range = settings.robot_range;
  const auto& budget = settings.budget;
  config.frame_time = budget.frame_time;
  config.state_bytes = budget.state_bytes;
  config.modal_trees = budget.modal_trees;
  config.tree_cost = budget.tree_cost;
  config.procedural_cost = budget.procedural_cost;
  config.modal_cost = budget.modal_cost;
  config.fine_cost = budget.fine_cost;
  config.physical_cost = budget.physical_cost;
  config.size = tuning.design.size;
  config.children = tuning.design.children;
  config.leaves = tuning.design.leaves;
  config.angle = tuning.design.angle;
  config.noise = tuning.design.noise;
  config.transition = tuning.transition;
}

// The server's own clamp lets NaN pass.
void check(ForestTuning tuning) {
  Faults faults;
  FieldChecker checker("", faults);
  describe(checker, tuning);
  faults.throwIfAny();
}

}  // namespace

void ForestAnimator::onWind(const WindField& message) {
  acceptInput("wind", [&] {
    checkFrame(message.header.frame_id, options_.frame_id);
    const wind::Field wind = fromMsg(message);
    ForestInput event;
    event.kind = ForestInput::WIND;
    event.wind_hash = wind.hash();
    winds_.keep(event.wind_hash, wind);
    heard_wind_ = event.wind_hash;
    enqueue(event);
  });
}

void ForestAnimator::onSensor(const SensorInterest& message) {
  acceptInput("sensor", [&] {
    ForestInput event;
    event.kind = ForestInput::SENSOR;
    event.stamp = fromMsg(message.header.stamp);
    event.sensor = fromMsg(message);
    const std::string& frame = message.header.frame_id;
    if (!frame.empty() && frame != options_.frame_id)
      event.sensor.position = transformed(poseOf(frame), event.sensor.position);
    inputs_.add(event);  // a full queue counts it as lost
  });
}

void ForestAnimator::showTuning(ForestAnimatorConfig& config) const {
  toConfig(tuning_, config);
}

ForestInput ForestAnimator::tuningEvent(const ForestAnimatorConfig& config) const {
  const ForestTuning tuning = fromConfig(config);
  check(tuning);
  return settingsEvent<ForestInput>(tuning);
}

}  // namespace vegetation_sim
