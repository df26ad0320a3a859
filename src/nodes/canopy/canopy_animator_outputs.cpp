// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/canopy/canopy_animator.h"
#include "ros/services/allocation_report.h"
#include "vegetation_sim/ros/conversions/canopy_conversions.h"

namespace vegetation_sim {

void CanopyAnimator::publishState(std::int64_t tick) {
  if (state_publisher_.getNumSubscribers() == 0) return;
  CanopyState message = toMsg(canopy_.update(tick % clock_.grid().rate() == 0));
  message.header.frame_id = options_.frame_id;
  state_bytes_ += ros::serialization::serializationLength(message);
  state_publisher_.publish(message);
}

void CanopyAnimator::sendMarkers(const ros::TimerEvent&) {
  if (!clock_.hasBegun() || markers_publisher_.getNumSubscribers() == 0) return;
  const canopy::Foliage& foliage = canopy_.foliage();
  Viewpoint eye;
  eye.position = canopy_.snapshot().cuts.now.position;
  markers_.choose(canopy_.layout(), eye, options_.tolerance, clock_.stamp());
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

void CanopyAnimator::addDiagnostics(Status& status) {
  status.add("Plants", canopy_.layout().plants.size());
  status.add("Leaves", canopy_.layout().leafCount());
  std::size_t crown_leaves = 0;
  for (const LeafedCrowns::Crown& crown : crowns_.crowns()) crown_leaves += crown.leaves.size();
  status.add("Leafed crowns", crowns_.crowns().size());
  status.add("Leaves of crowns", crown_leaves);
  status.add("Layers", canopy_.foliage().layers());
  status.add("Viewers", viewer_ ? 1 : 0);
  status.add("Messages of other viewers", other_viewers_);
  const std::uint64_t resets = canopy_.figures().resets;
  warnOfMore(status, resets, reported_resets_, "steps of the wind gave no number and were undone");
  reported_resets_ = resets;
  status.add("Steps undone", resets);
  status.add("Memory of the layers [B]", canopy_.snapshot().history.bytes());
  status.add("State sent [B]", state_bytes_);
}

// Reports the tiers of the markers; all of them share one motion of leaves.
void CanopyAnimator::diagnoseGovernor(Status& status) {
  report(markers_.balance(),
         {"Plants", options_.tolerance, "marker_points", "points",
          static_cast<double>(markers_.room()), markers_.tiers()},
         status);
  status.add("Marker points", markers_.points());
  status.add("Marker budget [points]", markers_.budget());
}

}  // namespace vegetation_sim
