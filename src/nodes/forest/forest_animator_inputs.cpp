// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
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
  config.transition = options_.tuning.transition;  // the only one that a scenario sets
}

ForestInput ForestAnimator::tuningEvent(const ForestAnimatorConfig& config) const {
  const ForestTuning tuning = fromConfig(config);
  check(tuning);
  return settingsEvent<ForestInput>(tuning);
}

}  // namespace vegetation_sim
