// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/grass/grass_source.h"

#include <algorithm>
#include <boost/bind/bind.hpp>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "vegetation_sim/ros/conversions/grass_conversions.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim::view {
namespace {

InputStatus refused(const std::exception& error) {
  return {false, std::string("Refused a message: ") + error.what()};
}

}  // namespace

GrassSource::GrassSource(ros::NodeHandle nh, const GrassTopics& topics)
    : layout_status_{false, "No layout on " + nh.resolveName(topics.layout)},
      wind_status_{false, "No wind on " + nh.resolveName(topics.wind) + ": still air"},
      state_status_{false, "No state on " + nh.resolveName(topics.state) + ": nothing trodden"} {
  layout_subscriber_ = nh.subscribe(topics.layout, 1, &GrassSource::takeLayout, this);
  wind_subscriber_ = nh.subscribe(topics.wind, 1, &GrassSource::takeWind, this);
  state_subscriber_ = nh.subscribe(topics.state, 100, &GrassSource::takeState, this);
}

void GrassSource::takeLayout(const GrassLayout& message) {
  try {
    meadow_ = MeadowReplica(message);
  } catch (const std::exception& error) {
    layout_status_ = refused(error);
    return;
  }
  pressed_.clear();
  ++layouts_;
  ++changes_;
  frame_ = message.header.frame_id;
  const grass::FeatureMap& map = *meadow_.layout.map;
  layout_status_ = {true, std::to_string(map.tileColumns()) + " x " +
                              std::to_string(map.tileRows()) + " tiles, " +
                              std::to_string(map.species().size()) + " species"};
}

void GrassSource::takeWind(const WindField& message) {
  try {
    wind_ = fromMsg(message);
  } catch (const std::exception& error) {
    wind_status_ = refused(error);
    return;
  }
  ++changes_;
  wind_status_ = {true, std::to_string(message.primitives.size()) + " primitives"};
}

void GrassSource::takeState(const GrassState& message) {
  try {
    const grass::TreadUpdate update = fromMsg(message);
    if (!ready() || update.layout_hash != meadow_.hash) {
      state_status_ = {
          false, ready() ? "Waiting: state belongs to another layout" : "Waiting for a layout"};
      return;
    }
    const bool taken = meadow_.replica.apply(update, *meadow_.tread);
    state_status_ = {taken,
                     taken ? "In step" : "Waiting for a key frame: " + meadow_.replica.why()};
    if (!taken || (!update.key_frame && update.treads.blocks.empty())) return;
    ++changes_;
    if (!update.key_frame) notePressed(update.treads);
  } catch (const std::exception& error) {
    state_status_ = refused(error);
  }
}

void GrassSource::notePressed(const grass::TreadDelta& treads) {
  const grass::MapLaw& law = meadow_.layout.map->law();
  const int cells = static_cast<int>(std::lround(law.resolution / meadow_.tread->spacing()));
  constexpr int SIDE = grass::TreadBlock::SIDE;
  // A node on an edge belongs to the tiles on both sides.
  const auto first = [&](int block) { return std::max(0, (block * SIDE - 1) / cells); };
  const auto last = [&](int block, int most) {
    return std::min(most - 1, (block * SIDE + SIDE - 1) / cells);
  };
  for (const grass::TreadBlockDelta& block : treads.blocks)
    for (int row = first(block.row); row <= last(block.row, law.rows - 1); ++row)
      for (int column = first(block.column); column <= last(block.column, law.columns - 1);
           ++column)
        pressed_.insert({row, column});
}

std::set<std::pair<int, int>> GrassSource::takePressed() {
  return std::exchange(pressed_, {});
}

void GrassSource::prune(Nanoseconds stamp) {
  if (ready()) meadow_.tread->prune(stamp);
}

void GrassSource::forgetState(Nanoseconds now) {
  if (!meadow_.forgetLater(now)) return;
  ++changes_;
  state_status_ = {false, "Waiting for a key frame: time went back"};
}

}  // namespace vegetation_sim::view
