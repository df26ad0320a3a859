// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/ForestLayout.h>
#include <vegetation_sim/ForestState.h>

#include "ros/replicas/shard_statuses.h"
#include "ros/replicas/subscribed_wind.h"
#include "vegetation_sim/forest/forest_replica.h"

namespace vegetation_sim {

/// The forest of another node, rebuilt from its layout, its state and the wind. Of a forest in
/// shards the messages of all of them are merged.
class SubscribedForest : public SubscribedReplica<ForestState> {
 public:
  struct Topics {
    std::string layout{"forest/layout"};
    std::string wind{"wind"};  ///< empty: setWind() is called instead
    std::string state{"forest/state"};
  };

  using FineModes = forest::ForestReplica::FineModes;
  explicit SubscribedForest(const ReplicaOptions& options = {},
                            FineModes fine_modes = FineModes::AT_ONCE);
  ~SubscribedForest() override { subscribers_.clear(); }

  /// @throws ros::InvalidNameException
  void subscribe(ros::NodeHandle handle, const Topics& topics);
  void setLayout(const ForestLayout& message);
  void setWind(const wind::Field& wind) { replica_.setWind(wind); }
  void apply(const ForestState& message) override;
  bool accepts(const ForestState& message) override;
  /// Time jumped back to `now`: a later state is dropped, and all trees are at rest until the next
  /// key frame.
  void forgetLater(Nanoseconds now);

  const forest::ForestReplica& replica() const { return replica_; }
  /// Number of accepted layouts.
  int layouts() const { return layouts_; }
  const InputStatus& layoutStatus() const { return layout_status_; }
  /// Each shard publishes layout and state.
  std::string rivals() const override {
    return joinRivals({describeRivals(subscribers_, replica_.shards()), wind_.rivals()});
  }
  const InputStatus& windStatus() const { return wind_.status(); }
  /// Returns the status of the states, of all shards. It names those that are not in use.
  InputStatus stateStatus(Nanoseconds now) const;
  /// Returns the status of the states of one shard. @param shard below replica().shards().
  InputStatus shardStatus(std::uint32_t shard, Nanoseconds now) const;

 private:
  InputStatus describeLayout() const;
  forest::ForestReplica replica_;
  SubscribedWind wind_;
  int layouts_{0};
  InputStatus layout_status_, state_status_;
  ShardStatuses shard_statuses_;
};

}  // namespace vegetation_sim
