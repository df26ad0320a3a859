// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "nodes/grass/grass_field.h"
#include "ros/services/allocation_report.h"
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
  GrassState message = toMsg(field_->update(key_frame));
  message.header.frame_id = options_.frame_id;
  const std::uint64_t bytes = ros::serialization::serializationLength(message);
  if (key_frame) key_frames_.sent(bytes);
  state_bytes_ += bytes;
  largest_state_ = std::max(largest_state_, bytes);
  state_publisher_.publish(message);
}

// Wrenches are in the body's frame; the force acts at the source.
void GrassField::publishWrenches(Nanoseconds stamp) {
  if (wrenches_publisher_.getNumSubscribers() == 0) return;
  for (const grass::Drag& drag : field_->drags()) {
    try {
      const Pose to_world = poseOf(drag.body_frame);
      const Quat back = conjugate(to_world.orientation);
      const Vec3 arm = drag.at - to_world.position;
      geometry_msgs::WrenchStamped message;
      message.header.stamp = toStamp(stamp);
      message.header.frame_id = drag.body_frame;
      message.wrench.force = toVector(rotate(back, drag.force));
      message.wrench.torque = toVector(rotate(back, cross(arm, drag.force)));
      wrenches_publisher_.publish(message);
    } catch (const InvalidInput&) {
      // The drag on a body without a frame cannot be reported.
    }
  }
}

void GrassField::sendMarkers(const ros::TimerEvent&) {
  if (!clock_.hasBegun() || markers_publisher_.getNumSubscribers() == 0) return;
  const Nanoseconds stamp = field_->stamp();
  const auto model = field_->layout().blade_model;
  markers_publisher_.publish(markers_.build(*meadow_, *tread_, viewers_.eyesAt(stamp), wind_, model,
                                            options_.frame_id, stamp));
}

void GrassField::sendCover(const ros::TimerEvent&) {
  if (!clock_.hasBegun()) return;
  const auto send = [&](const ros::Publisher& publisher, int layer) {
    if (publisher.getNumSubscribers() == 0) return;
    nav_msgs::OccupancyGrid message = coverOf(*field_, static_cast<CoverLayer>(layer),
                                              {options_.cover_resolution, options_.cover_age});
    message.header.frame_id = options_.frame_id;
    publisher.publish(message);
  };
  send(cover_publisher_, options_.cover_layer);
  for (std::size_t i = 0; i < layer_publishers_.size(); ++i)
    send(layer_publishers_[i], static_cast<int>(i));
}

void GrassField::addDiagnostics(Status& status) {
  sources_.missing().warn(name_, status);
  const grass::TreadState& tread = tread_->state();
  warnOfMore(status, tread.counts.no_memory, reported_no_memory_,
             "nodes left untrodden by the memory cap");
  reported_no_memory_ = tread.counts.no_memory;
  status.add("Sources", field_->sources().size());
  status.add("Sources without a position", sources_.missing().size());
  status.add("Strokes", tread.counts.strokes);
  status.add("Strokes off the map", tread.counts.outside);
  status.add("Jumps of sources", tread.counts.jumps);
  status.add("Trodden blocks", tread.blocks.size());
  status.add("Trodden ground [B]", tread_->bytes());
  status.add("Memory cap [B]",
             static_cast<std::uint64_t>(options_.scene.grass.treading.memory_cap));
  status.add("Nodes left out by the cap", tread.counts.no_memory);
  status.add("State sent [B]", state_bytes_);
  status.add("Largest state [B]", largest_state_);
  status.add("Viewers", viewers_.size());
}

// Reports the choice of tiers of the markers and the period of complete states.
void GrassField::diagnoseGovernor(Status& status) {
  report(meadow_->balance(),
         {"Tiles",
          tuning_.view.tolerance,
          "marker_points",
          "blades",
          options_.tuning.view.most_blades,
          {"of texture", "of strips", "of blades"}},
         status);
  status.add("Marker points", markers_.points());
  status.add("Marker budget [points]", markers_.budget());
  const TierAllocation& states = key_frames_.balance();
  if (states.held_back > 0) status.summary(status.level, status.message + "; state_bytes binds");
  status.add("Complete states every [s]", key_frames_.period());
  status.add("Complete states [B/s]", states.cost);
  status.add("Complete states that key_frame_period asks for [B/s]", states.wanted);
  status.add("State budget [B/s]", key_frames_.budget());
}

}  // namespace vegetation_sim
