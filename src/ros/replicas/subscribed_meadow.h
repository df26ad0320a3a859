// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/GrassColours.h>
#include <vegetation_sim/GrassLayout.h>
#include <vegetation_sim/GrassState.h>
#include <vegetation_sim/NearGrass.h>

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "core/lod/interest_regions.h"
#include "ros/replicas/shard_statuses.h"
#include "ros/replicas/subscribed_wind.h"
#include "vegetation_sim/grass/grass_layout.h"
#include "vegetation_sim/grass/lod/colour_mask.h"
#include "vegetation_sim/grass/tread/tread_update.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim {

/// The meadow of another node, rebuilt from its layout, its state and the wind. Of a meadow in
/// shards the messages of all of them are merged.
class SubscribedMeadow : public SubscribedReplica<GrassState> {
 public:
  struct Topics {
    std::string layout{"grass/layout"};
    std::string wind{"wind"};          ///< empty: no wind is needed
    std::string state{"grass/state"};  ///< empty: only `near` is used
    std::string colours{"grass/colours"};
    std::string near{};  ///< NearGrass, preferred to `state` while it has a publisher; may be empty
  };

  explicit SubscribedMeadow(const ReplicaOptions& options = {});
  ~SubscribedMeadow() override {
    near_subscriber_.shutdown();
    subscribers_.clear();
  }

  /// @throws ros::InvalidNameException
  void subscribe(ros::NodeHandle handle, const Topics& topics);
  /// Rejects a layout whose terrain has other heights here than where it was made.
  void setLayout(const GrassLayout& message);
  void apply(const GrassState& message) override;
  bool accepts(const GrassState& message) override;
  void apply(const NearGrass& message);
  bool accepts(const NearGrass& message);
  /// Applies the delayed states of both topics with stamps up to `stamp`.
  void advance(Nanoseconds stamp);
  /// Begins or ends to receive the state of the whole meadow.
  void listen(bool is_wanted);
  /// For displays: ends to receive the whole while `near` has a publisher.
  void selectTopic();
  /// Time jumped back to `now`: later tracks are dropped until the next key frame.
  void forgetLater(Nanoseconds now);
  /// Frees the memory of ground that has recovered at a stamp.
  void prune(Nanoseconds stamp);

  /// True after the first layout. layout(), terrain() and tread() require it.
  bool ready() const { return tread_ != nullptr; }
  const grass::Layout& layout() const { return layout_; }
  std::shared_ptr<const terrain::HeightMap> terrain() const { return terrain_; }
  const grass::TreadMap& tread() const { return *tread_; }
  const wind::Field& wind() const { return wind_.field(); }
  void setColours(const GrassColours& message);
  /// Discs that colour the grass; none until there is a message.
  const grass::ColourMasks& colours() const { return colours_; }
  /// Number of accepted layouts, and of changes of any kind.
  int layouts() const { return layouts_; }
  int changes() const { return changes_ + wind_.messages(); }
  /// Returns the tiles, by row and column, that were pressed since the last call.
  std::set<std::pair<int, int>> takePressed() { return std::exchange(pressed_, {}); }

  const InputStatus& layoutStatus() const { return layout_status_; }
  /// Each shard publishes layout and state.
  std::string rivals() const override {
    return joinRivals(
        {describeRivals(subscribers_, replica_.shards()), rivalsOfNear(), wind_.rivals()});
  }
  /// Returns rivals() of `near` only.
  std::string rivalsOfNear() const { return describeRivals({near_subscriber_}, replica_.shards()); }
  const InputStatus& windStatus() const { return wind_.status(); }
  /// Returns the status of the states, of all shards. It names those that are not in use.
  InputStatus stateStatus(Nanoseconds now) const;
  /// Stamp of the last update of the shard that is farthest behind, of those that are not silent:
  /// the ground of a silent one stays as it is. 0 if updates are ignored.
  Nanoseconds stamp() const;
  /// Returns whether all tracks within `radius` [m] of a place are known at `stamp`.
  bool covers(const Vec3& centre, double radius, Nanoseconds stamp) const;
  std::size_t waiting() const { return SubscribedReplica::waiting() + delayed_near_.size(); }
  std::uint64_t lost() const { return SubscribedReplica::lost() + delayed_near_.lost(); }
  /// Why states are ignored until the next key frame; empty if they are not.
  const std::string& why() const { return replica_.why(); }

 private:
  InputStatus describeLayout() const;
  /// The last update of a shard.
  struct Part {
    bool in_step{false};
    std::vector<InterestArea> discs{};  // that have all tracks; none: the whole meadow has
  };
  void receiveUpdate(const char* input, const GrassState& message,
                     const std::function<std::vector<InterestArea>()>& discs);
  void notePressed(const grass::TreadDelta& treads);
  bool isSilent(std::uint32_t shard) const;
  bool hasNear() const { return near_subscriber_.getNumPublishers() > 0; }

  grass::Layout layout_;
  std::uint64_t layout_hash_{0};
  std::shared_ptr<const terrain::HeightMap> terrain_;
  std::unique_ptr<grass::TreadMap> tread_;
  grass::TreadReplica replica_;
  grass::ColourMasks colours_;
  SubscribedWind wind_;
  int layouts_{0}, changes_{0};
  std::set<std::pair<int, int>> pressed_;
  std::map<std::uint32_t, Part> parts_;     // by shard
  Nanoseconds first_heard_{0}, newest_{0};  // stamps of updates in step
  DelayBuffer<boost::shared_ptr<const NearGrass>> delayed_near_;
  std::function<void()> subscribe_state_;  // null without a topic
  ros::Subscriber near_subscriber_;
  InputStatus layout_status_, state_status_;
  ShardStatuses shard_statuses_;
};

}  // namespace vegetation_sim
