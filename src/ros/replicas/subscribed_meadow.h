// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/GrassColours.h>
#include <vegetation_sim/GrassLayout.h>
#include <vegetation_sim/GrassState.h>

#include <memory>
#include <set>
#include <utility>

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
    std::string wind{"wind"};  ///< empty: no wind is needed
    std::string state{"grass/state"};
    std::string colours{"grass/colours"};
  };

  explicit SubscribedMeadow(const ReplicaOptions& options = {});
  ~SubscribedMeadow() override { subscribers_.clear(); }

  /// @throws ros::InvalidNameException
  void subscribe(ros::NodeHandle handle, const Topics& topics);
  /// Rejects a layout whose terrain has other heights here than where it was made.
  void setLayout(const GrassLayout& message);
  void apply(const GrassState& message) override;
  bool accepts(const GrassState& message) override;
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
    return describeRivals(subscribers_, replica_.shards()) + wind_.rivals();
  }
  const InputStatus& windStatus() const { return wind_.status(); }
  /// Returns the status of the states, of all shards. It names those that are not in use.
  InputStatus stateStatus(Nanoseconds now) const;
  /// Why states are ignored until the next key frame; empty if they are not.
  const std::string& why() const { return replica_.why(); }

 private:
  void notePressed(const grass::TreadDelta& treads);

  grass::Layout layout_;
  std::uint64_t layout_hash_{0};
  std::shared_ptr<const terrain::HeightMap> terrain_;
  std::unique_ptr<grass::TreadMap> tread_;
  grass::TreadReplica replica_;
  grass::ColourMasks colours_;
  SubscribedWind wind_;
  int layouts_{0}, changes_{0};
  std::set<std::pair<int, int>> pressed_;
  InputStatus layout_status_, state_status_;
  ShardStatuses shard_statuses_;
};

}  // namespace vegetation_sim
