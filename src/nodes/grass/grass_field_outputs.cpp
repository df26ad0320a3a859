// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "nodes/grass/grass_field.h"
#include "ros/conversions/crowd_conversions.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"

namespace vegetation_sim {

void GrassField::publishEntering(Nanoseconds stamp) {
  GrassEvent event;
  event.kind = GrassEvent::ENTER;
  event.header.stamp = toStamp(stamp);
  for (const grass::Entering& entering : field_->advance(stamp)) {
    event.source = entering.source;
    event.column = static_cast<std::uint32_t>(entering.column);
    event.row = static_cast<std::uint32_t>(entering.row);
    publishEvent(event);
  }
}

void GrassField::publishState(std::int64_t tick) {
  const bool key_frame = key_frames_.isDue(tick);
  const grass::TreadUpdate update = field_->update(key_frame);
  publishNear(update);
  GrassState message = toMsg(update);
  message.header.frame_id = options_.frame_id;
  const std::uint64_t bytes = ros::serialization::serializationLength(message);
  if (key_frame) key_frames_.sent(bytes);
  state_bytes_ += bytes;
  largest_state_ = std::max(largest_state_, bytes);
  state_publisher_.publish(message);
}

// Blocks that were out of all discs come with the key frame of a new disc.
void GrassField::publishNear(const grass::TreadUpdate& update) {
  if (near_publisher_.getNumSubscribers() == 0) return;
  std::vector<InterestArea> wanted = discsOf(viewers_.eyesAt(update.stamp), options_.view_range);
  for (const InterestArea& disc : sensors_.discsAt(update.stamp)) wanted.push_back(disc);
  const bool is_new = near_.update(wanted);
  const grass::MapLaw& law = field_->layout().map->law();
  const double side = grass::TreadBlock::SIDE * tread_->spacing();
  const grass::BlockFilter includes = [&](int row, int column) {
    return near_.includes(law.origin_x + side * column, law.origin_y + side * row, side);
  };
  grass::TreadUpdate part = update;
  if ((is_new || needs_near_frame_) && !update.key_frame) {
    part = field_->keyFrameOf(includes);
  } else {
    part.treads = selectBlocks(update.treads, includes);
    if (part.key_frame) part.hash = hashOf(part.treads);
  }
  part.sequence = near_sequence_++;
  needs_near_frame_ = false;
  NearGrass message;
  message.discs = toMsg(near_.discs());
  message.state = toMsg(part);
  message.state.header.frame_id = options_.frame_id;
  near_bytes_ += ros::serialization::serializationLength(message);
  near_publisher_.publish(message);
}

// Wrenches are in the body's frame; the force acts at the source.
GrassForces GrassField::forcesAt(Nanoseconds stamp) const {
  GrassForces out;
  out.header.stamp = toStamp(stamp);
  out.header.frame_id = options_.frame_id;
  for (const grass::Drag& drag : field_->drags()) {
    try {
      const Pose to_world = poseOf(drag.body_frame);
      const Quat back = conjugate(to_world.orientation);
      const Vec3 arm = drag.at - to_world.position;
      GrassForce force;
      force.source = drag.source;
      force.frame = drag.body_frame;
      force.point = toPoint(drag.at);
      force.force = toVector(drag.force);
      force.wrench.force = toVector(rotate(back, drag.force));
      force.wrench.torque = toVector(rotate(back, cross(arm, drag.force)));
      out.forces.push_back(std::move(force));
    } catch (const InvalidInput&) {
      // The drag on a body without a frame cannot be reported.
    }
  }
  return out;
}

void GrassField::publishForces(Nanoseconds stamp) {
  if (wrenches_publisher_.getNumSubscribers() + forces_publisher_.getNumSubscribers() == 0) return;
  const GrassForces forces = forcesAt(stamp);
  forces_publisher_.publish(forces);
  for (const GrassForce& force : forces.forces) {
    geometry_msgs::WrenchStamped message;
    message.header.stamp = forces.header.stamp;
    message.header.frame_id = force.frame;
    message.wrench = force.wrench;
    wrenches_publisher_.publish(message);
  }
}

bool GrassField::isCoverWanted() const {
  const auto is_wanted = [](const ros::Publisher& publisher) {
    return publisher.getNumSubscribers() > 0;
  };
  return is_wanted(cover_publisher_) || is_wanted(values_publisher_) ||
         std::any_of(layer_publishers_.begin(), layer_publishers_.end(), is_wanted);
}

const GrassCover& GrassField::untroddenCover() {
  if (untrodden_.density.empty())
    untrodden_ = groundOf(*field_->layout().map, options_.cover_resolution);
  return untrodden_;
}

GrassCover GrassField::makeCover() {
  return coverOf(*field_, untroddenCover(), options_.cover_resolution);
}

void GrassField::sendCover() {
  if (!isCoverWanted()) return;
  GrassCover cover = makeCover();
  addResistance(field_->drag(), cover);
  publishCover(std::move(cover));
}

void GrassField::sendCoverAt(std::int64_t tick) {
  if (covers_) followCoverParts(isCoverWanted());
  const std::int64_t period = periodOf(tick, options_.cover_rate, clock_.grid().rate());
  if (std::exchange(cover_period_, period) == period || recovers()) return;
  if (!covers_) {
    sendCoverPart();
    sendCover();
  } else if (isCoverWanted()) {
    if (auto before = covers_->begin(makeCover(), field_->drag())) publishCover(std::move(*before));
    if (auto joined = covers_->take()) publishCover(std::move(*joined));
  }
}

void GrassField::sendCoverPart() {
  if (cover_part_publisher_.getNumSubscribers() == 0) return;
  GrassCoverPart part = troddenCells(*field_, untroddenCover().info, options_.cover_resolution);
  part.header.frame_id = options_.frame_id;
  part.shard = options_.shard->index;
  cover_part_publisher_.publish(part);
}

void GrassField::publishCover(GrassCover cover) {
  cover.header.frame_id = options_.frame_id;
  if (values_publisher_.getNumSubscribers() > 0) values_publisher_.publish(cover);
  const auto send = [&](const ros::Publisher& publisher, CoverLayer layer) {
    if (publisher.getNumSubscribers() > 0)
      publisher.publish(percentOf(cover, layer, options_.cover_scale));
  };
  send(cover_publisher_, options_.cover_layer);
  for (std::size_t i = 0; i < layer_publishers_.size(); ++i)
    send(layer_publishers_[i], static_cast<CoverLayer>(i));
}

void GrassField::addDiagnostics(Status& status) {
  sources_.missing().warn(name_, status);
  cutters_.missing().warn(name_, status);
  const grass::TreadState& tread = tread_->state();
  warnOfMore(status, tread.counts.no_memory, reported_no_memory_,
             "nodes left untrodden by the memory cap");
  reported_no_memory_ = tread.counts.no_memory;
  const std::uint64_t uncut = tread_->cuts().state().no_memory;
  warnOfMore(status, uncut, reported_uncut_, "nodes left uncut by the memory cap");
  reported_uncut_ = uncut;
  warnOfMore(status, late_treads_, reported_late_,
             "treads came after their tick: shards may apply them at different ones");
  reported_late_ = late_treads_;
  warnOfMore(status, unsent_treads_, reported_unsent_,
             "times that a crowd's treads did not come within frame_wait");
  reported_unsent_ = unsent_treads_;
  if (isPart()) status.add("Treads after their tick", late_treads_);
  status.add("Treads of crowds awaited in vain", unsent_treads_);
  status.add("Sources", field_->sources().size());
  status.add("Sources without a position", sources_.missing().size());
  status.add("Cutters without a position", cutters_.missing().size());
  status.add("Transforms too late for their tick", sources_.late() + cutters_.late());
  status.add("Strokes", tread.counts.strokes);
  status.add("Strokes off the map", tread.counts.outside);
  status.add("Jumps of sources", tread.counts.jumps);
  status.add("Trodden blocks", tread.blocks.size());
  status.add("Trodden ground [B]", tread_->bytes());
  status.add("Memory cap [B]",
             static_cast<std::uint64_t>(options_.scene.grass.treading.memory_cap));
  status.add("Nodes left out by the cap", tread.counts.no_memory);
  status.add("Cut ground [B]", tread_->cuts().bytes());
  status.add("Nodes left uncut by the cap", uncut);
  status.add("State sent [B]", state_bytes_);
  status.add("Largest state [B]", largest_state_);
  status.add("Sent to viewers and sensors [B]", near_bytes_);
  status.add("Sensors", sensors_.size());
  status.add("Viewers", viewers_.size());
}

// Reports the choice of tiers of the markers and the period of complete states.
void GrassField::addGovernor(Status& status) {
  markers_->reportTiers(status);
  const TierAllocation& states = key_frames_.balance();
  if (states.held_back > 0) status.summary(status.level, status.message + "; state_bytes binds");
  status.add("Complete states every [s]", key_frames_.period());
  status.add("Complete states [B/s]", states.cost);
  status.add("Complete states that key_frame_period asks for [B/s]", states.wanted);
  status.add("State budget [B/s]", key_frames_.budget());
}

std::vector<PredictedError> GrassField::predictErrors() const {
  return {predictError("grass/markers", markers_->balance(), markers_->balanceTerms())};
}

}  // namespace vegetation_sim
