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
    forest::Layout layout = fromMsg(message);
    // The layout of another shard, which is the same.
    if (replica_.shards() > 1 && layout.hash() == replica_.layoutHash()) return describeLayout();
    replica_.setLayout(std::move(layout), loadPublishedTerrain(message.terrain));
    shard_statuses_.clear();
    frame_ = message.header.frame_id;
    ++layouts_;
    return describeLayout();
  });
}

InputStatus SubscribedForest::describeLayout() const {
  return {true, std::to_string(replica_.layout().treeCount()) + " trees of " +
                    std::to_string(replica_.layout().species.size()) + " species"};
}

bool SubscribedForest::accepts(const ForestState& message) {
  return receive("forest/state", state_status_, [&] {
    requireSoon(message.header.stamp);
    fromMsg(message);
    return state_status_;
  });
}

void SubscribedForest::apply(const ForestState& message) {
  receive("forest/state", state_status_, [&]() -> InputStatus {
    const std::uint32_t shards = replica_.shards();
    const bool is_in_step = replica_.apply(fromMsg(message));
    if (replica_.shards() != shards) shard_statuses_.clear();
    if (is_in_step) return {true, "In step"};
    return {false, "Waiting for a key frame: " + replica_.why()};
  });
  if (replica_.shards() > 1 && message.shard < replica_.shards())
    shard_statuses_.set(message.shard, state_status_);
}

InputStatus SubscribedForest::shardStatus(std::uint32_t shard, Nanoseconds now) const {
  if (replica_.shards() == 1) return unlessSilent(state_status_, replica_.stamp(), now);
  return shard_statuses_.of(shard, replica_.stampOf(shard), now);
}

InputStatus SubscribedForest::stateStatus(Nanoseconds now) const {
  if (replica_.shards() == 1) return shardStatus(0, now);
  return ShardStatuses::all(replica_.shards(),
                            [&](std::uint32_t shard) { return shardStatus(shard, now); });
}

void SubscribedForest::forgetLater(Nanoseconds now) {
  forgetDelayed(now);
  bool is_later = false;
  for (std::uint32_t shard = 0; shard < replica_.shards(); ++shard)
    is_later = is_later || replica_.stampOf(shard) > now;
  if (!replica_.ready() || !is_later) return;
  replica_.forgetState();
  shard_statuses_.clear();
  state_status_ = {false, "Waiting for a key frame: time went back"};
}

}  // namespace vegetation_sim
