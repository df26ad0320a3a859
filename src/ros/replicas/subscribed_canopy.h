// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/CanopyLayout.h>
#include <vegetation_sim/CanopyState.h>

#include <memory>
#include <vector>

#include "ros/replicas/leafed_crowns.h"
#include "vegetation_sim/canopy/canopy.h"

namespace vegetation_sim {

/// The plants of another node, rebuilt from their layout and state, and the forest if its crowns
/// have leaves of the layout.
class SubscribedCanopy : public SubscribedReplica<CanopyState> {
 public:
  struct Topics {
    std::string layout{"canopy/layout"}, state{"canopy/state"};
    SubscribedForest::Topics forest;  ///< used only if the layout has crowns
  };

  /// Whether the forest is subscribed for the crowns of a layout, or the user has it.
  enum class Forest { OWN, GIVEN };
  explicit SubscribedCanopy(const ReplicaOptions& options = {}, Forest forest = Forest::OWN)
      : SubscribedReplica(options), whose_forest_(forest) {}
  ~SubscribedCanopy() override { subscribers_.clear(); }

  /// @throws ros::InvalidNameException also for the topics of the forest.
  void subscribe(ros::NodeHandle handle, const Topics& topics);
  void setLayout(const CanopyLayout& message);
  void apply(const CanopyState& message) override;
  bool accepts(const CanopyState& message) override;
  /// Grows the crowns if the layout of the forest has changed.
  void updateCrowns();
  /// Does the same with a forest of the user.
  void updateCrowns(const SubscribedForest& forest);
  /// Time jumped back to `now`: a later state is dropped, and all leaves are at rest until the next
  /// state.
  void forgetLater(Nanoseconds now);

  /// Null before the first layout.
  canopy::Replica* replica() { return replica_.get(); }
  const canopy::Replica* replica() const { return replica_.get(); }
  /// Crowns that have leaves; none before the layout of the forest.
  const LeafedCrowns& crowns() const { return crowns_; }
  /// Base of each branch of a crown's tree at a stamp.
  std::vector<Pose> wood(std::size_t crown, Nanoseconds stamp) const {
    return crowns_.wood(crown, forest_->replica(), stamp);
  }
  /// Null if the layout has no crowns.
  const SubscribedForest* forest() const { return forest_.get(); }
  /// Number of accepted layouts, including those of the forest, and of changes of any kind.
  int layouts() const { return layouts_; }
  int changes() const { return changes_; }

  std::string rivals() const override {
    return joinRivals({SubscribedReplica::rivals(), forest_ ? forest_->rivals() : ""});
  }
  const InputStatus& layoutStatus() const { return layout_status_; }
  InputStatus stateStatus(Nanoseconds now) const {
    return unlessSilent(state_status_, stamp_, now);
  }

 private:
  void restart(const canopy::Layout& layout);

  Forest whose_forest_;
  ros::NodeHandle handle_;
  SubscribedForest::Topics forest_topics_;
  std::unique_ptr<SubscribedForest> forest_;
  LeafedCrowns crowns_;
  std::unique_ptr<canopy::Replica> replica_;
  Nanoseconds stamp_{0};
  int layouts_{0}, changes_{0};
  InputStatus layout_status_, state_status_;
};

}  // namespace vegetation_sim
