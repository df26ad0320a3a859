// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include "core/config/field_values.h"
#include "forest/knife.h"
#include "nodes/forest/forest_animator.h"
#include "tree/growth/broken_branch.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_TOOL_CUTS = 256;  // of a tick
constexpr double NO_GATE = std::numeric_limits<double>::infinity();

forest::Knife knifeOf(const CutterFollower::Stroke& stroke) {
  const grass::Cutter& tool = stroke.tool->cutter;
  return {tool.shape == grass::CutterShape::DISC, tool.length, tool.width, stroke.tool->thickest,
          stroke.from.value_or(stroke.to),        stroke.to};
}

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
    event.stamp = fromMsg(effectOf(message.header.stamp, clock_));
    event.sensor = fromMsg(message);
    const std::string& frame = message.header.frame_id;
    if (!frame.empty() && frame != options_.frame_id)
      event.sensor.position = transformed(poseOf(frame), event.sensor.position);
    inputs_.add(event);  // a full queue counts it as lost
  });
}

// Cuts what the tools meet on their way, in the pose of the last tick. A tool that stands cuts what
// moves into it.
void ForestAnimator::followCutters(Nanoseconds stamp) {
  std::vector<forest::Knife> knives;
  for (const auto& stroke : cutters_.follow(stamp, forest_->terrain(), NO_GATE))
    knives.push_back(knifeOf(stroke));
  const forest::TreePoser trees{[this](std::uint32_t id) {
                                  const auto grown = cache_.get(*forest_, id);
                                  return std::shared_ptr<const forest::Tree>(grown, &grown->tree);
                                },
                                [this](const forest::Tree& tree, std::uint32_t id) {
                                  return forest_->pose(tree, id, forest_->snapshot().stamp);
                                }};
  std::vector<forest::BranchCut> cuts =
      findCuts(forest_->layout(), forest_->grid(), forest_->terrain(), knives, trees);
  cuts.erase(std::remove_if(cuts.begin(), cuts.end(),
                            [this](const forest::BranchCut& cut) {
                              return !forest_->owners().owns(cut.tree);
                            }),
             cuts.end());
  const std::size_t broken = countBroken(forest_->broken());
  const std::size_t room =
      std::min(MOST_TOOL_CUTS, forest::MOST_BROKEN - std::min(forest::MOST_BROKEN, broken));
  if (cuts.size() > room) {
    left_uncut_ += cuts.size() - room;
    if (uncut_warning_.hasPassed())
      ROS_WARN("forest_animator: tools leave %zu branches uncut", cuts.size() - room);
    cuts.resize(room);
  }
  // The last one that is added is applied first.
  std::reverse(cuts.begin(), cuts.end());
  for (const forest::BranchCut& cut : cuts) {
    ForestInput event;
    event.kind = ForestInput::CUT;
    event.cut = cut;
    inputs_.addFirst(event);
  }
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
