// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/replicas/subscribed_canopy.h"

#include "vegetation_sim/ros/conversions/canopy_conversions.h"

namespace vegetation_sim {

void SubscribedCanopy::subscribe(ros::NodeHandle handle, const Topics& topics) {
  handle_ = handle;
  forest_topics_ = topics.forest;
  // Invalid names are reported now, although these topics are used only by layouts with crowns.
  for (const std::string& name : {topics.forest.layout, topics.forest.wind, topics.forest.state})
    handle.resolveName(name);
  layout_status_ = {false, "No layout on " + handle.resolveName(topics.layout)};
  state_status_ = {false, "No state on " + handle.resolveName(topics.state) + ": all at rest"};
  subscribers_ = {handle.subscribe(topics.layout, 1, &SubscribedCanopy::setLayout, this)};
  // The whole history may wait while the leaves of a layout are grown.
  subscribeState(handle, topics.state, 100);
}

void SubscribedCanopy::restart(const canopy::Layout& layout) {
  replica_ = std::make_unique<canopy::Replica>(layout);
  stamp_ = 0;
  ++changes_;
}

void SubscribedCanopy::setLayout(const CanopyLayout& message) {
  receive("canopy/layout", layout_status_, [&]() -> InputStatus {
    requireFrame(message.header.frame_id);
    restart(fromMsg(message));
    frame_ = message.header.frame_id;
    ++layouts_;
    crowns_.clear();
    const canopy::Layout& layout = replica_->layout();
    if (layout.crowns.empty() || whose_forest_ == Forest::GIVEN) {
      forest_.reset();
    } else if (!forest_) {
      forest_ =
          std::make_unique<SubscribedForest>(options_, SubscribedForest::FineModes::ONE_BY_ONE);
      forest_->subscribe(handle_, forest_topics_);
    }
    return {true, std::to_string(layout.plants.size()) + " plants, " +
                      std::to_string(layout.leafCount()) + " leaves"};
  });
}

bool SubscribedCanopy::accepts(const CanopyState& message) {
  return receive("canopy/state", state_status_, [&] {
    requireSoon(message.header.stamp);
    fromMsg(message);
    return state_status_;
  });
}

void SubscribedCanopy::apply(const CanopyState& message) {
  receive("canopy/state", state_status_, [&]() -> InputStatus {
    if (!replica_) return {false, "Waiting for a layout"};
    const canopy::StateUpdate update = fromMsg(message);
    replica_->apply(update);
    stamp_ = update.stamp;
    ++changes_;
    return {true, replica_->exact() ? "In step" : "Receiving the history of the layers"};
  });
}

void SubscribedCanopy::updateCrowns() {
  if (forest_) updateCrowns(*forest_);
}

void SubscribedCanopy::updateCrowns(const SubscribedForest& forest) {
  if (!replica_ || !crowns_.update(replica_->layout(), forest)) return;
  replica_->setCrowns(crowns_.boxes());
  ++layouts_;
  ++changes_;
}

void SubscribedCanopy::forgetLater(Nanoseconds now) {
  forgetDelayed(now);
  if (forest_) forest_->forgetLater(now);
  if (!replica_ || stamp_ <= now) return;
  restart(canopy::Layout(replica_->layout()));
  replica_->setCrowns(crowns_.boxes());
  state_status_ = {false, "Waiting for a state: time went back"};
}

}  // namespace vegetation_sim
