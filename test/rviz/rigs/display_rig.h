// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "rviz/forest/forest_display.h"
#include "rviz/rigs/view_rig.h"
#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim {

/// rviz and a forest that the rig publishes.
class DisplayRig : public ViewRig {
 public:
  DisplayRig() { startNode(); }

  /// Starts a node that publishes the forest. A node that already runs is stopped.
  void startNode() {
    for (ros::Publisher* publisher : {&layout_, &wind_, &state_}) publisher->shutdown();
    layout_ = nh_.advertise<ForestLayout>("forest/layout", 1, true);
    wind_ = nh_.advertise<WindField>("wind", 1, true);
    state_ = nh_.advertise<ForestState>("forest/view", 10, true);
  }

  ForestDisplay* addDisplay() { return add<ForestDisplay>("vegetation_sim/ForestDisplay"); }

  void publishForest(const forest::Layout& layout) {
    hash_ = layout.hash();
    ForestLayout message = toMsg(layout);
    message.header.frame_id = "map";
    layout_.publish(message);
    wind_field_ = wind::Field({forest::makeBreeze(1, Vec3(6.0, 1.0, 0.0))});
    wind_.publish(toMsg(wind_field_, "map", 0));
    publishState();
  }
  void publish(const ForestLayout& message) { layout_.publish(message); }
  void publish(const WindField& message) { wind_.publish(message); }
  void publish(const ForestState& message) { state_.publish(message); }
  /// Publishes a state with all trees at a level of motion, by default the finest.
  void publishState() { publishState(now()); }
  void publishState(double stamp, int level = forest::MAX_DEPTHS) {
    forest::StateUpdate update;
    update.stamp = fromSeconds(stamp);
    update.base = forest::LevelState::settled(level);
    update.layout_hash = hash_;
    update.wind_hash = wind_field_.hash();
    ForestState message = toMsg(update);
    message.header.frame_id = "map";
    state_.publish(message);
  }

 private:
  ros::Publisher layout_, wind_, state_;
  wind::Field wind_field_;
  std::uint64_t hash_{0};
};

}  // namespace vegetation_sim
