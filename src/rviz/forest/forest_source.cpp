// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/forest/forest_source.h"

#include <boost/bind/bind.hpp>
#include <stdexcept>

#include "ros/params/resources.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim::view {
namespace {

InputStatus refused(const std::exception& error) {
  return {false, std::string("Refused a message: ") + error.what()};
}

}  // namespace

ForestSource::ForestSource(ros::NodeHandle nh, const ForestTopics& topics)
    : layout_status_{false, "No layout on " + nh.resolveName(topics.layout)},
      wind_status_{false, "No wind on " + nh.resolveName(topics.wind) + ": still air"},
      state_status_{false, "No state on " + nh.resolveName(topics.state) + ": all at rest"} {
  layout_ = nh.subscribe(topics.layout, 1, &ForestSource::takeLayout, this);
  wind_ = nh.subscribe(topics.wind, 1, &ForestSource::takeWind, this);
  state_ = nh.subscribe(topics.state, 100, &ForestSource::takeState, this);
}

void ForestSource::takeLayout(const ForestLayout& message) {
  try {
    replica_.setLayout(fromMsg(message), loadTerrain(message.terrain));
  } catch (const std::exception& error) {
    layout_status_ = refused(error);
    return;
  }
  ++layouts_;
  frame_ = message.header.frame_id;
  layout_status_ = {true, std::to_string(replica_.layout().treeCount()) + " trees of " +
                              std::to_string(replica_.layout().species.size()) + " species"};
}

void ForestSource::takeWind(const WindField& message) {
  try {
    replica_.setWind(fromMsg(message));
  } catch (const std::exception& error) {
    wind_status_ = refused(error);
    return;
  }
  wind_status_ = {true, std::to_string(message.primitives.size()) + " primitives"};
}

void ForestSource::takeState(const ForestState& message) {
  try {
    const bool taken = replica_.apply(fromMsg(message));
    state_status_ = {taken, taken ? "In step" : "Waiting for a key frame: " + replica_.why()};
  } catch (const std::exception& error) {
    state_status_ = refused(error);
  }
}

void ForestSource::forgetState(Nanoseconds now) {
  if (!replica_.ready() || replica_.stamp() <= now) return;
  forest::StateUpdate still;
  still.layout_hash = replica_.layoutHash();
  replica_.apply(still);
  forest::StateUpdate lost = still;  // out of sequence: a key frame has to come first
  lost.key_frame = false;
  lost.sequence = still.sequence + 2;
  replica_.apply(lost);
  state_status_ = {false, "Waiting for a key frame: time went back"};
}

}  // namespace vegetation_sim::view
