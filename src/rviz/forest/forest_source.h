// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <vegetation_sim/ForestLayout.h>
#include <vegetation_sim/ForestState.h>
#include <vegetation_sim/WindField.h>

#include <string>

#include "rviz/scenery/input_status.h"
#include "vegetation_sim/forest/forest_replica.h"

namespace vegetation_sim::view {

struct ForestTopics {
  std::string layout, wind, state;
};

/// Listens to a forest and keeps the replica of it. Callbacks run in the queue of the node handle:
/// for a display the render thread's. A refused message changes nothing.
class ForestSource {
 public:
  /// @throws ros::InvalidNameException for a topic that cannot be.
  ForestSource(ros::NodeHandle nh, const ForestTopics& topics);

  const forest::ForestReplica& replica() const { return replica_; }
  /// Counts layouts taken.
  int layouts() const { return layouts_; }
  /// Frame of the layout; empty before the first.
  const std::string& frame() const { return frame_; }
  /// Time went back to `now`: forgets the levels of a later time until the next key frame. One of
  /// after the jump that has come already is kept.
  void forgetState(Nanoseconds now);

  const InputStatus& layoutStatus() const { return layout_status_; }
  const InputStatus& windStatus() const { return wind_status_; }
  InputStatus stateStatus(Nanoseconds now) const {
    return unlessSilent(state_status_, replica_.stamp(), now);
  }

 private:
  void takeLayout(const ForestLayout& message);
  void takeWind(const WindField& message);
  void takeState(const ForestState& message);

  forest::ForestReplica replica_;
  int layouts_{0};
  std::string frame_;
  InputStatus layout_status_, wind_status_, state_status_;
  ros::Subscriber layout_, wind_, state_;
};

}  // namespace vegetation_sim::view
