// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/canopy/canopy_animator.h"
#include "nodes/canopy/pushing_bodies.h"
#include "vegetation_sim/ros/conversions/canopy_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {

void CanopyAnimator::publishState(std::int64_t tick) {
  if (state_publisher_.getNumSubscribers() == 0) return;
  const bool hashed = tick % clock_.grid().rate() == 0;
  CanopyState message = toMsg(canopy_.update(hashed, hashed || cuts_changed_));
  cuts_changed_ = false;
  message.header.frame_id = options_.frame_id;
  state_bytes_ += ros::serialization::serializationLength(message);
  state_publisher_.publish(message);
}

// Once a second, and at once after a cut or for a new subscriber.
void CanopyAnimator::publishCover(std::int64_t tick) {
  const std::uint32_t subscribers = cover_publisher_.getNumSubscribers();
  const bool is_new = subscribers > cover_subscribers_;
  cover_subscribers_ = subscribers;
  if (subscribers == 0 || canopy_.layout().plants.empty()) return;
  if (!is_new && !cuts_changed_ && tick % clock_.grid().rate() != 0) return;
  nav_msgs::OccupancyGrid message = cover_.cutShare(canopy_.snapshot().push.stubble);
  message.header.stamp = toStamp(clock_.stamp());
  message.header.frame_id = options_.frame_id;
  cover_publisher_.publish(message);
}

// The last message after the last body has no forces.
void CanopyAnimator::publishContacts() {
  const bool has_bodies = !canopy_.bodies().empty();
  if (has_bodies || had_bodies_) {
    PlantContacts message = contactsOf(canopy_);
    message.header.frame_id = options_.frame_id;
    contacts_publisher_.publish(message);
  }
  had_bodies_ = has_bodies;
}

// The markers are for the viewer that layers are cut for.
std::vector<Viewpoint> CanopyAnimator::markerViewers(Nanoseconds) {
  Viewpoint out;
  out.position = canopy_.snapshot().cuts.now.position;
  return {out};
}

void CanopyAnimator::addDiagnostics(Status& status) {
  bodies_.missing().warn(name_, status);
  cutters_.missing().warn(name_, status);
  status.add("Frames of bodies without a transform", bodies_.missing().size());
  status.add("Cutters without a position", cutters_.missing().size());
  status.add("Transforms too late for their tick", bodies_.late() + cutters_.late());
  for (const std::string& link : options_.robot.left_out)
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, link);
  status.add("Bodies", canopy_.bodies().size());
  status.add("People too late for their tick", people_.late());
  status.add("Bodies left out", bodies_left_out_);
  status.add("Plants that bodies have pushed", canopy_.snapshot().push.plants.size());
  warnOfMore(status, canopy_.refusedPushes(), reported_refused_,
             "times a plant did not lean: too many cells do");
  reported_refused_ = canopy_.refusedPushes();
  status.add("Plants that have been cut", canopy_.snapshot().push.stubble.size());
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

std::vector<PredictedError> CanopyAnimator::predictErrors() const {
  return {predictError("canopy/markers", markers_.balance(), markers_.balanceTerms())};
}

}  // namespace vegetation_sim
