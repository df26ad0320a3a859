// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/replicas/subscribed_meadow.h"

#include <algorithm>
#include <cmath>

#include "ros/conversions/crowd_conversions.h"
#include "ros/params/resources.h"
#include "ros/services/subscriptions.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double MEMORY_CAP = 1e9;  // [bytes] of trodden ground
constexpr double FRESH = 0.5;       // age of an update that stands for the ground at a stamp [s]
constexpr double REACH = 3.0;       // of blades and of the way of a sensor in a sweep [m]

}  // namespace

SubscribedMeadow::SubscribedMeadow(const ReplicaOptions& options)
    : SubscribedReplica(options), wind_(options) {}

void SubscribedMeadow::subscribe(ros::NodeHandle handle, const Topics& topics) {
  layout_status_ = {false, "No layout on " + handle.resolveName(topics.layout)};
  state_status_ = {false, "No state on " + handle.resolveName(topics.state) + ": no tracks"};
  if (!topics.wind.empty()) wind_.subscribe(handle, topics.wind);
  subscribers_ = {handle.subscribe(topics.layout, 1, &SubscribedMeadow::setLayout, this),
                  handle.subscribe(topics.colours, 1, &SubscribedMeadow::setColours, this)};
  if (!topics.near.empty()) {
    const boost::function<void(const boost::shared_ptr<const NearGrass>&)> callback =
        [this](const boost::shared_ptr<const NearGrass>& message) {
          if (!options_.delayed)
            apply(*message);
          else if (accepts(*message))
            delayed_near_.add(fromMsg(message->state.header.stamp),
                              ros::serialization::serializationLength(*message), message);
        };
    near_subscriber_ = subscribeWithoutDelay<NearGrass>(handle, topics.near, 100, callback);
  }
  if (topics.state.empty()) return;
  subscribe_state_ = [this, handle, topic = topics.state]() mutable {
    subscribeState(handle, topic, 100);
  };
  subscribe_state_();
}

// The subscriber of the state is the last one.
void SubscribedMeadow::listen(bool is_wanted) {
  constexpr std::size_t OTHERS = 2;
  if (!subscribe_state_ || is_wanted == (subscribers_.size() > OTHERS)) return;
  if (is_wanted)
    subscribe_state_();
  else
    subscribers_.pop_back();
}

void SubscribedMeadow::selectTopic() {
  if (near_subscriber_) listen(!hasNear());
}

void SubscribedMeadow::advance(Nanoseconds stamp) {
  SubscribedReplica::advance(stamp);
  delayed_near_.take(stamp, [this](Nanoseconds, const auto& message) { apply(*message); });
}

void SubscribedMeadow::setLayout(const GrassLayout& message) {
  receive("grass/layout", layout_status_, [&]() -> InputStatus {
    requireFrame(message.header.frame_id);
    grass::Layout layout = fromMsg(message);
    // The layout of another shard, which is the same.
    if (ready() && replica_.shards() > 1 && layout.hash() == layout_hash_) return describeLayout();
    auto terrain = loadPublishedTerrain(layout.terrain);
    if (terrain->hash() != layout.terrain_hash)
      throw InvalidInput("layout: terrain = " + inQuotes(layout.terrain, LONGEST_ADDRESS) +
                         " has other heights here than where it was made");
    grass::TreadSettings settings;
    settings.spacing = layout.tread_spacing;
    settings.memory_cap = MEMORY_CAP;
    tread_ = std::make_unique<grass::TreadMap>(layout.map->law(), settings);
    layout_ = std::move(layout);
    layout_hash_ = layout_.hash();
    terrain_ = std::move(terrain);
    replica_.reset();
    parts_.clear();
    shard_statuses_.clear();
    pressed_.clear();
    frame_ = message.header.frame_id;
    ++layouts_;
    ++changes_;
    return describeLayout();
  });
}

InputStatus SubscribedMeadow::describeLayout() const {
  const grass::FeatureMap& map = *layout_.map;
  return {true, std::to_string(map.tileColumns()) + " x " + std::to_string(map.tileRows()) +
                    " tiles, " + std::to_string(map.species().size()) + " species"};
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
    requireSoon(message.header.stamp);
    fromMsg(message);
    return state_status_;
  });
}

bool SubscribedMeadow::accepts(const NearGrass& message) {
  return receive("grass/near", state_status_,
                 [&] {
                   fromMsg(message.discs);
                   return state_status_;
                 }) &&
         accepts(message.state);
}

void SubscribedMeadow::apply(const GrassState& message) {
  if (!hasNear()) receiveUpdate("grass/state", message, [] { return std::vector<InterestArea>(); });
}

void SubscribedMeadow::apply(const NearGrass& message) {
  receiveUpdate("grass/near", message.state, [&] { return fromMsg(message.discs); });
}

void SubscribedMeadow::receiveUpdate(const char* input, const GrassState& message,
                                     const std::function<std::vector<InterestArea>()>& discs) {
  receive(input, state_status_, [&]() -> InputStatus {
    const grass::TreadUpdate update = fromMsg(message);
    Part part{false, discs()};
    if (!ready()) return {false, "Waiting for a layout"};
    if (update.layout_hash != layout_hash_)
      return {false, "Waiting: state belongs to another layout"};
    const std::uint32_t shards = replica_.shards();
    const bool jumps =
        parts_.count(update.shard) > 0 && update.stamp < replica_.stampOf(update.shard);
    part.in_step = replica_.apply(update, *tread_);
    if (replica_.shards() != shards) {
      parts_.clear();
      shard_statuses_.clear();
    }
    if (parts_.empty()) first_heard_ = update.stamp;
    // A shard that catches up does not make those in step look silent.
    newest_ = parts_.empty() || jumps ? update.stamp : std::max(newest_, update.stamp);
    const bool is_other_ground = parts_[update.shard].discs != part.discs;
    parts_[update.shard] = part;
    if (!part.in_step) return {false, "Waiting for a key frame: " + replica_.why()};
    if (update.key_frame || !update.treads.blocks.empty() || !update.treads.cuts.empty())
      ++changes_;
    if (!update.key_frame || is_other_ground) notePressed(update.treads);
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

bool SubscribedMeadow::isSilent(std::uint32_t shard) const {
  return isSilentShard(parts_.count(shard) > 0 ? replica_.stampOf(shard) : first_heard_, newest_);
}

Nanoseconds SubscribedMeadow::stamp() const {
  Nanoseconds out = 0;
  for (std::uint32_t shard = 0; shard < replica_.shards(); ++shard) {
    if (isSilent(shard)) continue;
    const auto part = parts_.find(shard);
    if (part == parts_.end() || !part->second.in_step) return 0;
    const Nanoseconds last = replica_.stampOf(shard);
    out = out == 0 ? last : std::min(out, last);
  }
  return out;
}

bool SubscribedMeadow::covers(const Vec3& centre, double radius, Nanoseconds stamp) const {
  const Nanoseconds last = this->stamp();
  return last != 0 && secondsBetween(last, stamp) <= FRESH &&
         std::all_of(parts_.begin(), parts_.end(), [&](const auto& part) {
           return part.second.discs.empty() || isSilent(part.first) ||
                  vegetation_sim::covers(part.second.discs,
                                         {centre.x(), centre.y(), radius + REACH});
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
  delayed_near_.forgetLater(now);
  bool is_later = false;
  for (std::uint32_t shard = 0; shard < replica_.shards(); ++shard)
    is_later = is_later || replica_.stampOf(shard) > now;
  if (!ready() || !is_later) return;
  tread_->clear();
  replica_.reset();
  parts_.clear();
  shard_statuses_.clear();
  ++changes_;
  state_status_ = {false, "Waiting for a key frame: time went back"};
}

}  // namespace vegetation_sim
