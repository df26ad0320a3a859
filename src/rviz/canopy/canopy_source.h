// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <vegetation_sim/CanopyLayout.h>
#include <vegetation_sim/CanopyState.h>

#include <memory>
#include <string>

#include "ros/replicas/leafed_crowns.h"
#include "rviz/forest/forest_source.h"
#include "rviz/ground/ground_source.h"
#include "vegetation_sim/canopy/canopy.h"

namespace vegetation_sim::view {

struct CanopyTopics {
  std::string layout, state;
  ForestTopics forest;  ///< whose crowns have leaves, if the layout says so
};

/// Listens to leafy masses, and to the forest if they have crowns on it, and keeps the replica of
/// them. Callbacks run in the queue of the node
/// handle: for a display the render thread's. A refused message changes nothing.
class CanopySource {
 public:
  /// @throws ros::InvalidNameException for a topic that cannot be.
  CanopySource(ros::NodeHandle nh, const CanopyTopics& topics);

  /// Null before the first layout.
  canopy::Replica* replica() { return replica_.get(); }
  const canopy::Replica* replica() const { return replica_.get(); }
  /// Crowns that leaves hang on: none before the forest's layout.
  const LeafedCrowns& crowns() const { return crowns_; }
  /// Base of each branch of a crown's tree at a stamp.
  std::vector<Pose> wood(std::size_t crown, Nanoseconds stamp) const {
    return crowns_.wood(crown, forest_->replica(), stamp);
  }
  /// The forest; null if nobody asks for it.
  const ForestSource* forest() const { return forest_.get(); }
  /// Grows crowns if there is another forest.
  void keepCrowns();
  const terrain::HeightMap& ground() const { return ground_.ground(); }
  /// Counts layouts taken, of the crowns' forest too, and states.
  int layouts() const { return layouts_; }
  int states() const { return states_; }
  const std::string& frame() const { return frame_; }
  /// Time went back to `now`: a state of a later time is void, all are at rest until the next.
  void forgetState(Nanoseconds now);

  const InputStatus& layoutStatus() const { return layout_status_; }
  InputStatus stateStatus(Nanoseconds now) const {
    return unlessSilent(state_status_, stamp_, now);
  }

 private:
  void takeLayout(const CanopyLayout& message);
  void takeState(const CanopyState& message);

  ros::NodeHandle nh_;
  CanopyTopics topics_;
  GroundSource ground_;
  std::unique_ptr<ForestSource> forest_;
  LeafedCrowns crowns_;
  int forests_{0};
  std::unique_ptr<canopy::Replica> replica_;
  Nanoseconds stamp_{0};
  int layouts_{0}, states_{0};
  std::string frame_;
  InputStatus layout_status_, state_status_;
  ros::Subscriber layout_, state_;
};

}  // namespace vegetation_sim::view
