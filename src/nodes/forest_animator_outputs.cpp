// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/nodes/forest_animator.h"
#include "vegetation_sim/ros/forest_conversions.h"

namespace vegetation_sim {

void ForestAnimator::sendFrames(const ros::TimerEvent&) {
  // Every listener warns of a transform that comes twice.
  if (last_tick_ == last_framed_tick_ || frames_.empty()) return;
  last_framed_tick_ = last_tick_;
  tf_broadcaster_.sendTransform(
      branchTransforms(frames_, *forest_, cache_, options_.frame_id, forest_->memory().stamp));
}

void ForestAnimator::sendBranches(const ros::TimerEvent&) {
  if (last_tick_ == NEVER || branches_publisher_.getNumSubscribers() == 0) return;
  const Nanoseconds stamp = forest_->memory().stamp;
  std::size_t sent = 0;
  for (const int id : options_.branches_trees) {
    const auto tree = static_cast<std::uint32_t>(id);
    const auto grown = cache_.get(forest_->layout(), forest_->terrain(), tree);
    sent += grown->tree.skeleton.branches.size();
    if (sent > static_cast<std::size_t>(options_.branches_budget)) {
      ROS_WARN_THROTTLE(10.0, "forest_animator: branches_budget = %d ends at tree %d",
                        options_.branches_budget, id);
      return;
    }
    BranchTransforms message =
        toMsg(tree, grown->tree.foot, posesOf(*forest_, grown->tree, tree, stamp));
    message.header.stamp = toStamp(stamp);
    message.header.frame_id = options_.frame_id;
    branches_publisher_.publish(message);
  }
}

void ForestAnimator::sendMarkers(const ros::TimerEvent&) {
  if (last_tick_ == NEVER || markers_publisher_.getNumSubscribers() == 0) return;
  markers_publisher_.publish(
      markers_.build(*forest_, cache_, options_.frame_id, forest_->memory().stamp));
}

// What has happened since the last report, and only that.
void ForestAnimator::warnOfTrouble(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const auto warn = [&](std::uint64_t now, std::uint64_t before, const std::string& text) {
    if (now > before)
      status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN,
                          std::to_string(now - before) + " " + text);
  };
  warn(counts_.rejected, reported_.rejected, "refused input: " + last_rejection_);
  warn(counts_.dropped, reported_.dropped, "ticks dropped");
  warn(counts_.jumps, reported_.jumps, "jumps back of the clock");
  warn(counts_.inputs.lost, reported_.inputs.lost, "inputs lost, too many at once");
  warn(counts_.inputs.late, reported_.inputs.late, "recorded events late, the replay differs");
  reported_ = counts_;
}

void ForestAnimator::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  status.summary(DiagnosticStatus::OK, "running");
  if (last_tick_ == NEVER) status.summary(DiagnosticStatus::WARN, "waiting for the clock");
  warnOfTrouble(status);
  const auto& memory = forest_->memory();
  status.add("Trees", forest_->layout().treeCount());
  status.add("Trees not at the base level", memory.levels.held().size());
  status.add("Base level", memory.levels.base().level);
  status.add("Viewers", memory.viewers.size());
  status.add("Ticks", counts_.ticks);
  status.add("Ticks dropped", counts_.dropped);
  status.add("Clock jumps back", counts_.jumps);
  status.add("Inputs refused", counts_.rejected);
  status.add("Inputs lost", counts_.inputs.lost);
  status.add("Recorded events late", counts_.inputs.late);
  status.add("State sent [B]", counts_.state_bytes);
  status.add("Grown branches held", cache_.branches());
  status.add("tf frames", frames_.count());
  status.add("tf budget [frames]", frames_.budget());
  status.add("Marker points", markers_.points());
  status.add("Marker budget [points]", markers_.budget());
}

}  // namespace vegetation_sim
