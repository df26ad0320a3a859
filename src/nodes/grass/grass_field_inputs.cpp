// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/config/field_values.h"
#include "nodes/grass/grass_field.h"
#include "ros/services/requests.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim {

void GrassField::onWind(const WindField& message) {
  try {
    checkFrame(message.header.frame_id, options_.frame_id);
    wind_ = fromMsg(message);
  } catch (const InvalidInput& error) {
    refusals_.add("wind", error.what());
  }
}

// Looks only: the state does not depend on it, so it is no event.
void GrassField::onViewer(const Viewer& message) {
  try {
    viewers_.hear(message, tf_buffer_, options_.frame_id, clock_.hasBegun() ? clock_.stamp() : 0);
  } catch (const InvalidInput& error) {
    refusals_.add("viewer", error.what());
  }
}

void GrassField::lookFromFrame() {
  if (options_.viewer_frame.empty()) return;
  Viewer viewer;
  viewer.id = "tf:" + options_.viewer_frame;
  viewer.header.frame_id = options_.viewer_frame;
  viewer.pose.orientation.w = 1.0;
  viewer.field_of_view = options_.viewer_field_of_view;
  viewer.height = static_cast<std::uint32_t>(options_.viewer_height);
  onViewer(viewer);
}

TreadEvent GrassField::inWorld(const TreadEvent& message) const {
  TreadEvent out = message;
  const std::string& frame = message.header.frame_id;
  if (!frame.empty() && frame != options_.frame_id && message.action != TreadEvent::LIFT) {
    const Pose to_world = poseInWorld(tf_buffer_, options_.frame_id, frame);
    out.start = toPoint(transformed(to_world, fromMsg(message.start)));
    out.position = toPoint(transformed(to_world, fromMsg(message.position)));
    out.velocity = toVector(rotate(to_world.orientation, fromMsg(message.velocity)));
  }
  out.header.frame_id = options_.frame_id;
  return out;
}

void GrassField::onTread(const TreadEvent& message) {
  try {
    GrassEvent event;
    event.kind = GrassEvent::TREAD;
    event.header.stamp = effectOf(message.header.stamp, clock_);
    event.tread = toMsg(fromMsg(inWorld(message), tuning_.tread, tuning_.height_gate));
    event.tread.header.frame_id = options_.frame_id;
    inputs_.add(std::move(event));
  } catch (const InvalidInput& error) {
    refusals_.add("tread", error.what());
  }
}

void GrassField::followSources(Nanoseconds stamp) {
  for (const grass::TreadInput& input :
       sources_->update(stamp, tuning_.tread, tuning_.height_gate)) {
    Faults faults;
    check(input, "source: ", faults);
    if (!faults.empty()) {
      refusals_.add("source '" + input.source + "'", faults.text());
      continue;
    }
    GrassEvent event;
    event.kind = GrassEvent::TREAD;
    event.tread = toMsg(input);
    event.tread.header.frame_id = options_.frame_id;
    inputs_.add(std::move(event));
  }
}

void GrassField::onEvent(const GrassEvent& message) {
  if (message.kind != GrassEvent::ENTER) inputs_.addRecorded(message);
}

void GrassField::onTuning(GrassFieldConfig& config) {
  if (!shown_) {
    toConfig(tuning_, config);  // some may come from the scenario
    shown_ = config;
    return;
  }
  try {
    refuseInReplay();
    const GrassTuning tuning = fromConfig(config, tuning_.view);
    check(tuning);  // the server's own clamp lets NaN pass
    NamedValues named = namedValues(tuning);
    GrassEvent event;
    event.kind = GrassEvent::SETTINGS;
    event.names = std::move(named.names);
    event.values = std::move(named.values);
    inputs_.add(std::move(event));
    shown_ = config;
  } catch (const InvalidInput& error) {
    refusals_.add("settings", error.what());
    config = *shown_;
  }
}

}  // namespace vegetation_sim
