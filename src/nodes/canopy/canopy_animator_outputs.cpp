// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/canopy/canopy_animator.h"
#include "ros/services/allocation_report.h"
#include "vegetation_sim/ros/conversions/canopy_conversions.h"

namespace vegetation_sim {

void CanopyAnimator::publishState(std::int64_t tick) {
  if (state_publisher_.getNumSubscribers() == 0) return;
  CanopyState message = toMsg(canopy_->update(tick % clock_.grid().rate() == 0));
  message.header.frame_id = options_.frame_id;
  counts_.state_bytes += ros::serialization::serializationLength(message);
  state_publisher_.publish(message);
}

void CanopyAnimator::sendMarkers(const ros::TimerEvent&) {
  if (!clock_.hasBegun() || markers_publisher_.getNumSubscribers() == 0) return;
  const canopy::Foliage& foliage = canopy_->foliage();
  Viewpoint eye;
  eye.position = canopy_->snapshot().cuts.now.position;
  markers_.choose(canopy_->layout(), eye, options_.tolerance, clock_.stamp());
  markers_publisher_.publish(markers_.build(foliage, crownLeaves(foliage), options_.frame_id));
}

std::vector<canopy::MovedLeaf> CanopyAnimator::crownLeaves(const canopy::Foliage& foliage) const {
  std::vector<canopy::MovedLeaf> out;
  for (std::size_t i = 0; i < crowns_.crowns().size(); ++i) {
    const LeafedCrowns::Crown& crown = crowns_.crowns()[i];
    const std::vector<Pose> wood = crowns_.wood(i, forest_.replica(), clock_.stamp());
    for (std::size_t k = 0; k < markers_.drawnOf(crown.leaves.size()); ++k) {
      const canopy::CrownLeaf& leaf = crown.leaves[k];
      out.push_back(carry(foliage, leaf, crown.rest[leaf.twig].pose, wood[leaf.twig]));
    }
  }
  return out;
}

// What has happened since the last report, and only that.
void CanopyAnimator::reportProblem(diagnostic_updater::DiagnosticStatusWrapper& status) {
  counts_.clock = clock_.counts();
  counts_.inputs = inputs_.losses();
  counts_.resets = canopy_->figures().resets;
  refusals_.warn(status);
  warnOfClock(status, counts_.clock, reported_.clock);
  warnOfLosses(status, counts_.inputs, reported_.inputs);
  warnOfMore(status, counts_.resets, reported_.resets,
             "steps of the wind gave no number and were undone");
  reported_ = counts_;
}

void CanopyAnimator::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  status.summary(DiagnosticStatus::OK, "running");
  if (!clock_.hasBegun()) status.summary(DiagnosticStatus::WARN, "waiting for the clock");
  reportProblem(status);
  status.add("Plants", canopy_->layout().plants.size());
  status.add("Leaves", canopy_->layout().leafCount());
  std::size_t crown_leaves = 0;
  for (const LeafedCrowns::Crown& crown : crowns_.crowns()) crown_leaves += crown.leaves.size();
  status.add("Leafed crowns", crowns_.crowns().size());
  status.add("Leaves of crowns", crown_leaves);
  status.add("Layers", canopy_->foliage().layers());
  status.add("Viewers", viewer_ ? 1 : 0);
  status.add("Messages of other viewers", counts_.other_viewers);
  clock_.report(status);
  status.add("Inputs refused", refusals_.count());
  status.add("Inputs lost", counts_.inputs.lost);
  status.add("Recorded events late", counts_.inputs.late);
  status.add("Steps undone", counts_.resets);
  status.add("Memory of the layers [B]", canopy_->snapshot().history.bytes());
  status.add("State sent [B]", counts_.state_bytes);
}

// Of the markers; how leaves move is the same for all of them.
void CanopyAnimator::diagnoseGovernor(diagnostic_updater::DiagnosticStatusWrapper& status) {
  report(markers_.balance(),
         {"Plants", options_.tolerance, "marker_points", "points",
          static_cast<double>(markers_.room()), markers_.tiers()},
         status);
  status.add("Marker points", markers_.points());
  status.add("Marker budget [points]", markers_.budget());
}

}  // namespace vegetation_sim
