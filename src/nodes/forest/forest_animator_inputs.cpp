// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/archive/archive.h"
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

// What a snapshot of the node holds besides events that wait, and inputs to which events refer.
std::uint64_t ForestAnimator::sceneHash() const {
  forest::Layout layout = options_.scene.layout;
  layout.terrain_hash = options_.scene.terrain->hash();
  return layout.hash();
}

void ForestAnimator::writeState(Archive& a) const {
  NamedValues tuning = namedValues(tuning_);
  archiveNames(a, tuning);
  std::string state = forest_->archived();
  a.text("forest", state, LARGEST_SNAPSHOT);
  GrabManager::State grabs = grab_manager_.state();
  GrabManager::archive(a, grabs);
  RobotBodies::Seen bodies = bodies_.seen();
  RobotBodies::archive(a, bodies);
}

CheckedState ForestAnimator::readState(Archive& a) {
  NamedValues named;
  archiveNames(a, named);
  const auto tuning = fromNamedValues<ForestTuning>(named);
  std::string state;
  a.text("forest", state, LARGEST_SNAPSHOT);
  GrabManager::State grabs;
  GrabManager::archive(a, grabs);
  RobotBodies::Seen bodies;
  RobotBodies::archive(a, bodies);
  const forest::Layout layout = designedLayout(tuning);
  // A state can be read by a forest of its layout only.
  std::optional<forest::Forest> other;
  if (layout.hash() != forest_->layoutHash())
    other.emplace(layout, options_.scene.terrain, tuning.settings);
  const forest::Forest& reader = other ? *other : *forest_;
  const auto read =
      std::make_shared<forest::ForestSnapshot>(reader.readArchived(std::move(state), a.shift()));
  return {reader.hashOf(*read), [=] {
            applyTuning(tuning);
            forest_->restore(*read);
            grab_manager_.restore(grabs);
            bodies_.restore(bodies);
            deepest_ = {};
            last_framed_.reset();
            force_key_frame_ = true;
            winds_.keep(read->wind.hash(), read->wind);
            queueNewerWind();
          }};
}

// The wind that is published now stays in force.
void ForestAnimator::queueNewerWind() {
  ForestInput event;
  event.kind = ForestInput::WIND;
  event.wind_hash = heard_wind_;
  if (heard_wind_ != 0 && heard_wind_ != forest_->snapshot().wind.hash()) inputs_.add(event);
}

std::string ForestAnimator::inputOf(const ForestInput& event) const {
  return event.kind == ForestInput::WIND ? windBytes(winds_, event.wind_hash) : std::string();
}

std::function<void()> ForestAnimator::readInput(ForestInput& event, const std::string& bytes,
                                                Nanoseconds shift) {
  const wind::Field wind = windOfBytes(bytes, shift);
  event.wind_hash = wind.hash();
  return [this, wind] { winds_.keep(wind.hash(), wind); };
}

}  // namespace vegetation_sim
