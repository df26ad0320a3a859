// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/replicas/subscribed_forest.h"

#include "ros/params/resources.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"

namespace vegetation_sim {

SubscribedForest::SubscribedForest(const ReplicaOptions& options, FineModes fine_modes)
    : SubscribedReplica(options),
      replica_(fine_modes),
      wind_(options, [this](const wind::Field& wind) { replica_.setWind(wind); }) {}

void SubscribedForest::subscribe(ros::NodeHandle handle, const Topics& topics) {
  layout_status_ = {false, "No layout on " + handle.resolveName(topics.layout)};
  state_status_ = {false, "No state on " + handle.resolveName(topics.state) + ": all at rest"};
  if (!topics.wind.empty()) wind_.subscribe(handle, topics.wind);
  subscribers_ = {handle.subscribe(topics.layout, 1, &SubscribedForest::setLayout, this)};
  subscribeState(handle, topics.state, 100);
}

void SubscribedForest::setLayout(const ForestLayout& message) {
  receive("forest/layout", layout_status_, [&]() -> InputStatus {
    requireFrame(message.header.frame_id);
    replica_.setLayout(fromMsg(message), loadPublishedTerrain(message.terrain));
    frame_ = message.header.frame_id;
    ++layouts_;
    return {true, std::to_string(replica_.layout().treeCount()) + " trees of " +
                      std::to_string(replica_.layout().species.size()) + " species"};
  });
}

bool SubscribedForest::accepts(const ForestState& message) {
  return receive("forest/state", state_status_, [&] {
    fromMsg(message);
    return state_status_;
  });
}

void SubscribedForest::apply(const ForestState& message) {
  receive("forest/state", state_status_, [&]() -> InputStatus {
    if (replica_.apply(fromMsg(message))) return {true, "In step"};
    return {false, "Waiting for a key frame: " + replica_.why()};
  });
}

void SubscribedForest::forgetLater(Nanoseconds now) {
  forgetDelayed(now);
  if (!replica_.ready() || replica_.stamp() <= now) return;
  replica_.forgetState();
  state_status_ = {false, "Waiting for a key frame: time went back"};
}

}  // namespace vegetation_sim
