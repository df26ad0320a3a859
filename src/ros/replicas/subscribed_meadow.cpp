// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/replicas/subscribed_meadow.h"

#include <algorithm>
#include <cmath>

#include "ros/params/resources.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double MEMORY_CAP = 1e9;  // [bytes] of trodden ground

}  // namespace

SubscribedMeadow::SubscribedMeadow(const ReplicaOptions& options)
    : SubscribedReplica(options), wind_(options) {}

void SubscribedMeadow::subscribe(ros::NodeHandle handle, const Topics& topics) {
  layout_status_ = {false, "No layout on " + handle.resolveName(topics.layout)};
  state_status_ = {false, "No state on " + handle.resolveName(topics.state) + ": no tracks"};
  if (!topics.wind.empty()) wind_.subscribe(handle, topics.wind);
  subscribers_ = {handle.subscribe(topics.layout, 1, &SubscribedMeadow::setLayout, this),
                  handle.subscribe(topics.colours, 1, &SubscribedMeadow::setColours, this)};
  subscribeState(handle, topics.state, 100);
}

void SubscribedMeadow::setLayout(const GrassLayout& message) {
  receive("grass/layout", layout_status_, [&]() -> InputStatus {
    requireFrame(message.header.frame_id);
    grass::Layout layout = fromMsg(message);
    // The layout of another shard, which is the same.
    if (ready() && replica_.shards() > 1 && layout.hash() == layout_hash_) return layout_status_;
    auto terrain = loadPublishedTerrain(layout.terrain);
    if (terrain->hash() != layout.terrain_hash)
      throw InvalidInput("layout: terrain = '" + layout.terrain +
                         "' has other heights here than where it was made");
    grass::TreadSettings settings;
    settings.spacing = layout.tread_spacing;
    settings.memory_cap = MEMORY_CAP;
    tread_ = std::make_unique<grass::TreadMap>(layout.map->law(), settings);
    layout_ = std::move(layout);
    layout_hash_ = layout_.hash();
    terrain_ = std::move(terrain);
    replica_.reset();
    shard_statuses_.clear();
    pressed_.clear();
    frame_ = message.header.frame_id;
    ++layouts_;
    ++changes_;
    const grass::FeatureMap& map = *layout_.map;
    return {true, std::to_string(map.tileColumns()) + " x " + std::to_string(map.tileRows()) +
                      " tiles, " + std::to_string(map.species().size()) + " species"};
  });
}

void SubscribedMeadow::setColours(const GrassColours& message) {
  receive("grass/colours", state_status_, [&]() -> InputStatus {
    requireFrame(message.header.frame_id);
    colours_ = fromMsg(message);
    ++changes_;
    return state_status_;
  });
}

bool SubscribedMeadow::accepts(const GrassState& message) {
  return receive("grass/state", state_status_, [&] {
    fromMsg(message);
    return state_status_;
  });
}

void SubscribedMeadow::apply(const GrassState& message) {
  receive("grass/state", state_status_, [&]() -> InputStatus {
    const grass::TreadUpdate update = fromMsg(message);
    if (!ready()) return {false, "Waiting for a layout"};
    if (update.layout_hash != layout_hash_)
      return {false, "Waiting: state belongs to another layout"};
    if (!replica_.apply(update, *tread_))
      return {false, "Waiting for a key frame: " + replica_.why()};
    if (update.key_frame || !update.treads.blocks.empty() || !update.treads.cuts.empty())
      ++changes_;
    if (!update.key_frame) notePressed(update.treads);
    return {true, "In step"};
  });
  if (replica_.shards() > 1 && message.shard < replica_.shards())
    shard_statuses_.set(message.shard, state_status_);
}

InputStatus SubscribedMeadow::stateStatus(Nanoseconds now) const {
  if (replica_.shards() == 1) return unlessSilent(state_status_, replica_.stampOf(0), now);
  return ShardStatuses::all(replica_.shards(), [&](std::uint32_t shard) {
    return shard_statuses_.of(shard, replica_.stampOf(shard), now);
  });
}

void SubscribedMeadow::notePressed(const grass::TreadDelta& treads) {
  const grass::MapLaw& law = layout_.map->law();
  const int cells = static_cast<int>(std::lround(law.resolution / tread_->spacing()));
  constexpr int SIDE = grass::TreadBlock::SIDE;
  // A node on an edge belongs to the tiles on both sides.
  const auto first = [&](int block) { return std::max(0, (block * SIDE - 1) / cells); };
  const auto last = [&](int block, int most) {
    return std::min(most - 1, (block * SIDE + SIDE - 1) / cells);
  };
  const auto add = [&](const auto& block) {
    for (int row = first(block.row); row <= last(block.row, law.rows - 1); ++row)
      for (int column = first(block.column); column <= last(block.column, law.columns - 1);
           ++column)
        pressed_.insert({row, column});
  };
  for (const grass::TreadBlockDelta& block : treads.blocks) add(block);
  for (const grass::CutBlockDelta& block : treads.cuts) add(block);
}

void SubscribedMeadow::prune(Nanoseconds stamp) {
  if (ready()) tread_->prune(stamp);
}

void SubscribedMeadow::forgetLater(Nanoseconds now) {
  forgetDelayed(now);
  bool is_later = false;
  for (std::uint32_t shard = 0; shard < replica_.shards(); ++shard)
    is_later = is_later || replica_.stampOf(shard) > now;
  if (!ready() || !is_later) return;
  tread_->clear();
  replica_.reset();
  shard_statuses_.clear();
  ++changes_;
  state_status_ = {false, "Waiting for a key frame: time went back"};
}

}  // namespace vegetation_sim
