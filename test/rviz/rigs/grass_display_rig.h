// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/NearGrass.h>

#include "grass/tread_simulation.h"
#include "rviz/grass/grass_display.h"
#include "rviz/rigs/view_rig.h"
#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim {

/// rviz and a meadow that the rig publishes and treads.
class GrassRig : public ViewRig {
 public:
  GrassRig() { startNode(); }

  /// Starts a node that publishes the meadow. A node that already runs is stopped.
  void startNode() {
    for (ros::Publisher* publisher : {&layout_, &wind_, &state_, &colours_}) publisher->shutdown();
    layout_ = nh_.advertise<GrassLayout>("grass/layout", 1, true);
    wind_ = nh_.advertise<WindField>("wind", 1, true);
    state_ = nh_.advertise<GrassState>("grass/state", 10, true);
    colours_ = nh_.advertise<GrassColours>("grass/colours", 1, true);
  }

  GrassDisplay* addDisplay() { return add<GrassDisplay>("vegetation_sim/GrassDisplay"); }

  /// Returns a flat meadow of `tiles` x `tiles` around the origin with two species of different
  /// heights.
  static grass::Layout meadow(int tiles) {
    grass::MapInput input;
    input.law.columns = input.law.rows = tiles + 1;
    input.law.origin_x = input.law.origin_y = -0.5 * tiles * input.law.resolution;
    input.density.value = 500.0;
    input.species.resize(2);
    input.species[1].species.name = "daisy";
    input.species[1].species.flower_radius = 0.02;
    input.species[1].mix.value = 0.05;
    grass::Layout layout;
    layout.map = std::make_shared<const grass::FeatureMap>(input);
    layout.seed = 5;
    layout.terrain_hash = terrain::HeightMap().hash();
    return layout;
  }

  void publishMeadow(const grass::Layout& layout, double speed = 3.0) {
    grass::TreadSettings settings;
    settings.spacing = layout.tread_spacing;
    tread_ = std::make_unique<grass::TreadMap>(layout.map->law(), settings);
    hash_ = layout.hash();
    GrassLayout message = toMsg(layout);
    message.header.frame_id = "map";
    layout_.publish(message);
    wind_.publish(toMsg(wind::Field({forest::makeBreeze(1, Vec3(speed, 1.0, 0.0))}), "map", 0));
    publishState();
  }
  void publish(const GrassLayout& message) { layout_.publish(message); }
  void publish(const WindField& message) { wind_.publish(message); }
  void publish(const GrassState& message) { state_.publish(message); }
  void publish(const GrassColours& message) { colours_.publish(message); }

  /// Treads a track from a to b in steps of 5 cm and publishes it at once in a key frame.
  void tread(const grass::Point& a, const grass::Point& b, double recovery = 1e9) {
    grass::TreadLaw law;
    law.recovery = recovery;
    const double way = std::hypot(b.x - a.x, b.y - a.y);
    const int steps = static_cast<int>(way / 0.05) + 1;
    for (int k = 0; k <= steps; ++k) {
      const double s = static_cast<double>(k) / steps;
      tread_->tread(1, law, {a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)}, fromSeconds(now()));
    }
    tread_->lift(1);
    publishState();
  }
  /// Publishes the tracks around a place as a node does that knows its listeners.
  void publishNear(const grass::Point& place, double radius) {
    if (near_.getTopic().empty()) near_ = nh_.advertise<NearGrass>("grass/near", 10, true);
    NearGrass message;
    message.discs.resize(1);
    message.discs[0].x = place.x;
    message.discs[0].y = place.y;
    message.discs[0].radius = radius;
    const grass::MapLaw& law = tread_->law();
    const double side = grass::TreadBlock::SIDE * tread_->spacing();
    message.state = stateAt(now(), [&](int row, int column) {
      return std::hypot(law.origin_x + side * column - place.x,
                        law.origin_y + side * row - place.y) < radius;
    });
    near_.publish(message);
  }
  void stopNear() { near_.shutdown(); }
  /// Number of displays that receive the tracks of the whole meadow.
  std::uint32_t readersOfAll() const { return state_.getNumSubscribers(); }
  void publishState() { publishState(now()); }
  void publishState(double stamp) {
    state_.publish(stateAt(stamp, [](int, int) { return true; }));
  }

 private:
  GrassState stateAt(double stamp, const grass::BlockFilter& includes) {
    grass::TreadUpdate update;
    update.stamp = fromSeconds(stamp);
    update.sequence = ++sequence_;
    update.key_frame = true;
    update.layout_hash = hash_;
    update.treads = selectBlocks(snapshotTreads(tread_->state(), update.stamp), includes);
    update.hash = hashOf(update.treads);
    GrassState message = toMsg(update);
    message.header.frame_id = "map";
    return message;
  }

  ros::Publisher layout_, wind_, state_, near_, colours_;
  std::unique_ptr<grass::TreadMap> tread_;
  std::uint64_t hash_{0};
  std::uint32_t sequence_{0};
};

}  // namespace vegetation_sim
