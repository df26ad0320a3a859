// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/canopy/canopy_source.h"

#include <boost/bind/bind.hpp>
#include <stdexcept>

#include "vegetation_sim/ros/conversions/canopy_conversions.h"

namespace vegetation_sim::view {
namespace {

InputStatus refused(const std::exception& error) {
  return {false, std::string("Refused a message: ") + error.what()};
}

}  // namespace

CanopySource::CanopySource(ros::NodeHandle nh, const CanopyTopics& topics)
    : nh_(nh),
      topics_(topics),
      ground_(nh),
      layout_status_{false, "No layout on " + nh.resolveName(topics.layout)},
      state_status_{false, "No state on " + nh.resolveName(topics.state) + ": all at rest"} {
  // Their names are looked at now, though they are heard only where a layout has crowns.
  for (const std::string& name : {topics.forest.layout, topics.forest.wind, topics.forest.state})
    nh.resolveName(name);
  layout_ = nh.subscribe(topics.layout, 1, &CanopySource::takeLayout, this);
  // All of a history may wait while the layout's leaves are grown.
  state_ = nh.subscribe(topics.state, 100, &CanopySource::takeState, this);
}

void CanopySource::takeLayout(const CanopyLayout& message) {
  try {
    replica_ = std::make_unique<canopy::Replica>(fromMsg(message));
  } catch (const std::exception& error) {
    layout_status_ = refused(error);
    return;
  }
  ++layouts_;
  ++states_;
  stamp_ = 0;
  frame_ = message.header.frame_id;
  const canopy::Layout& layout = replica_->layout();
  crowns_.clear();
  forests_ = 0;
  if (layout.crowns.empty())
    forest_.reset();
  else if (!forest_)
    forest_ = std::make_unique<ForestSource>(nh_, topics_.forest);
  layout_status_ = {true, std::to_string(layout.plants.size()) + " plants, " +
                              std::to_string(layout.leafCount()) + " leaves"};
}

void CanopySource::takeState(const CanopyState& message) {
  if (!replica_) {
    state_status_ = {false, "Waiting for a layout"};
    return;
  }
  try {
    const canopy::StateUpdate update = fromMsg(message);
    replica_->apply(update);
    stamp_ = update.stamp;
  } catch (const std::exception& error) {
    state_status_ = refused(error);
    return;
  }
  ++states_;
  state_status_ = {true, replica_->exact() ? "In step" : "Hearing the memory of the layers"};
}

void CanopySource::keepCrowns() {
  if (!forest_ || forests_ == forest_->layouts()) return;
  forests_ = forest_->layouts();
  crowns_.grow(replica_->layout(), forest_->replica());
  replica_->setCrowns(crowns_.boxes());
  ++layouts_;
  ++states_;
}

void CanopySource::forgetState(Nanoseconds now) {
  if (forest_) forest_->forgetState(now);
  if (!replica_ || stamp_ <= now) return;
  replica_ = std::make_unique<canopy::Replica>(canopy::Layout(replica_->layout()));
  replica_->setCrowns(crowns_.boxes());
  ++states_;
  stamp_ = 0;
  state_status_ = {false, "Waiting for a state: time went back"};
}

}  // namespace vegetation_sim::view
