// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <geometry_msgs/WrenchStamped.h>

#include <algorithm>

#include "nodes/grass/grass_field.h"
#include "ros/services/allocation_report.h"
#include "ros/services/requests.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"

namespace vegetation_sim {
void GrassField::publishEntering(Nanoseconds stamp) {
  GrassEvent event;
  event.kind = GrassEvent::ENTER;
  event.header.stamp = toStamp(stamp);
  event.header.frame_id = options_.frame_id;
  for (const grass::Entering& entering : field_->advance(stamp)) {
    if (options_.replay) continue;
    event.source = entering.source;
    event.column = static_cast<std::uint32_t>(entering.column);
    event.row = static_cast<std::uint32_t>(entering.row);
    events_publisher_.publish(event);
  }
}

void GrassField::publishState(std::int64_t tick) {
  const bool key_frame = key_frames_.isDue(tick);
  GrassState message = toMsg(field_->update(key_frame));
  message.header.frame_id = options_.frame_id;
  const std::uint64_t bytes = ros::serialization::serializationLength(message);
  if (key_frame) key_frames_.sent(bytes);
  counts_.state_bytes += bytes;
  counts_.largest_state = std::max(counts_.largest_state, bytes);
  state_publisher_.publish(message);
}

// In the axes of the body's frame, which tf must know; the force acts where the source is.
void GrassField::publishWrenches(Nanoseconds stamp) {
  if (wrenches_publisher_.getNumSubscribers() == 0) return;
  for (const grass::Drag& drag : field_->drags()) {
    try {
      const Pose to_world = poseInWorld(tf_buffer_, options_.frame_id, drag.body_frame);
      const Quat back = conjugate(to_world.orientation);
      const Vec3 arm = drag.at - to_world.position;
      geometry_msgs::WrenchStamped message;
      message.header.stamp = toStamp(stamp);
      message.header.frame_id = drag.body_frame;
      message.wrench.force = toVector(rotate(back, drag.force));
      message.wrench.torque = toVector(rotate(back, cross(arm, drag.force)));
      wrenches_publisher_.publish(message);
    } catch (const InvalidInput&) {
      // Of a body without a frame nobody can feel the drag.
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

// What has happened since the last report, and only that.
void GrassField::reportProblem(diagnostic_updater::DiagnosticStatusWrapper& status) {
  counts_.clock = clock_.counts();
  counts_.inputs = inputs_.losses();
  counts_.tread = tread_->state().counts;
  refusals_.warn(status);
  warnOfClock(status, counts_.clock, reported_.clock);
  warnOfLosses(status, counts_.inputs, reported_.inputs);
  warnOfMore(status, counts_.tread.no_memory, reported_.tread.no_memory,
             "nodes left untrodden by the memory cap");
  reported_ = counts_;
}

void GrassField::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  status.summary(DiagnosticStatus::OK, "running");
  if (!clock_.hasBegun()) status.summary(DiagnosticStatus::WARN, "waiting for the clock");
  reportProblem(status);
  const grass::TreadState& tread = tread_->state();
  clock_.report(status);
  status.add("Inputs taken", counts_.events);
  status.add("Inputs refused", refusals_.count());
  status.add("Inputs lost", counts_.inputs.lost);
  status.add("Recorded events late", counts_.inputs.late);
  status.add("Sources", field_->sources().size());
  status.add("Sources not told", sources_->missing().size());
  status.add("Strokes", tread.counts.strokes);
  status.add("Strokes off the map", tread.counts.outside);
  status.add("Jumps of sources", tread.counts.jumps);
  status.add("Trodden blocks", tread.blocks.size());
  status.add("Trodden ground [B]", tread_->bytes());
  status.add("Memory cap [B]", static_cast<std::uint64_t>(scene_.grass.treading.memory_cap));
  status.add("Nodes left out by the cap", tread.counts.no_memory);
  status.add("State sent [B]", counts_.state_bytes);
  status.add("Largest state [B]", counts_.largest_state);
  status.add("Viewers", viewers_.size());
}

// Of the markers, whose tiers all have the same trodden ground, and of complete states.
void GrassField::diagnoseGovernor(diagnostic_updater::DiagnosticStatusWrapper& status) {
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
