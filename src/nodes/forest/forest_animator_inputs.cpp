// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <tf2/exceptions.h>

#include "nodes/forest/forest_animator.h"
#include "ros/services/requests.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
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

Quat toQuat(const geometry_msgs::Quaternion& q) {
  return {q.w, q.x, q.y, q.z};
}

// A pose in the frame that `transform` leads to.
geometry_msgs::Pose moved(const geometry_msgs::Pose& pose, const geometry_msgs::Transform& by) {
  const Vec3 offset(by.translation.x, by.translation.y, by.translation.z);
  const Quat turn = toQuat(by.rotation);
  Pose inner;
  inner.position = rotate(turn, Vec3(pose.position.x, pose.position.y, pose.position.z));
  inner.orientation = turn * toQuat(pose.orientation);
  return toMsg(offset, inner);
}

}  // namespace

void ForestAnimator::onWind(const WindField& message) {
  try {
    checkFrame(message.header.frame_id, options_.frame_id);
    inputs_.addWind(fromMsg(message));
  } catch (const InvalidInput& error) {
    refusals_.add("wind", error.what());
  }
}

void ForestAnimator::onViewer(const Viewer& message) {
  Viewer in_world = message;
  try {
    fromMsg(message);  // checks it
    if (!message.header.frame_id.empty() && message.header.frame_id != options_.frame_id) {
      in_world.pose = moved(message.pose, toWorld(message.header.frame_id, ros::Time(0)));
    }
    in_world.header.frame_id = options_.frame_id;
    fromMsg(in_world);
    inputs_.addViewer(in_world);
  } catch (const InvalidInput& error) {
    refusals_.add("viewer", error.what());
  }
}

geometry_msgs::Transform ForestAnimator::toWorld(const std::string& frame,
                                                 const ros::Time& stamp) const {
  try {
    return tf_buffer_.lookupTransform(options_.frame_id, frame, stamp).transform;
  } catch (const tf2::TransformException& error) {
    throw InvalidInput("frame_id = '" + frame + "' is not known in '" + options_.frame_id +
                       "': " + error.what());
  }
}

void ForestAnimator::lookFromFrame() {
  if (options_.viewer_frame.empty()) return;
  Viewer viewer;
  viewer.id = "tf:" + options_.viewer_frame;
  viewer.header.frame_id = options_.viewer_frame;
  viewer.pose.orientation.w = 1.0;
  viewer.field_of_view = options_.viewer_field_of_view;
  viewer.height = static_cast<std::uint32_t>(options_.viewer_height);
  onViewer(viewer);
}

void ForestAnimator::onTuning(ForestAnimatorConfig& config) {
  if (!shown_) {
    config.transition = tuning_.transition;  // may come from the scenario
    shown_ = config;
    return;
  }
  try {
    if (options_.replay) throw InvalidInput("a replay follows its recorded events only");
    check(fromConfig(config));
    inputs_.addTuning(fromConfig(config));
    shown_ = config;
  } catch (const InvalidInput& error) {
    refusals_.add("settings", error.what());
    config = *shown_;
  }
}

}  // namespace vegetation_sim
