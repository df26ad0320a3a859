// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <vegetation_sim/GrassLayout.h>
#include <vegetation_sim/GrassState.h>
#include <vegetation_sim/WindField.h>

#include <memory>
#include <set>
#include <string>
#include <utility>

#include "ros/replicas/meadow_replica.h"
#include "rviz/scenery/input_status.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::view {

struct GrassTopics {
  std::string layout, wind, state;
};

/// Listens to a meadow and keeps a copy of it. Callbacks run in the queue of the node handle: for a
/// display the render thread's. A refused message changes nothing.
class GrassSource {
 public:
  /// @throws ros::InvalidNameException for a topic that cannot be.
  GrassSource(ros::NodeHandle nh, const GrassTopics& topics);

  /// True once there is a layout. Requires it: layout(), terrain(), tread().
  bool ready() const { return meadow_.ready(); }
  const grass::Layout& layout() const { return meadow_.layout; }
  std::shared_ptr<const terrain::HeightMap> terrain() const { return meadow_.terrain; }
  const grass::TreadMap& tread() const { return *meadow_.tread; }
  const wind::Field& wind() const { return wind_; }
  /// Counts layouts taken, and changes of any kind.
  int layouts() const { return layouts_; }
  int changes() const { return changes_; }
  /// Tiles that were pressed since the last call, by row and column.
  std::set<std::pair<int, int>> takePressed();
  /// Frees ground that has recovered.
  void prune(Nanoseconds stamp);
  /// Frame of the layout; empty before the first.
  const std::string& frame() const { return frame_; }
  /// Time went back to `now`: what was trodden later is void until the next key frame. One of after
  /// the jump that has come already is kept.
  void forgetState(Nanoseconds now);

  const InputStatus& layoutStatus() const { return layout_status_; }
  const InputStatus& windStatus() const { return wind_status_; }
  InputStatus stateStatus(Nanoseconds now) const {
    return unlessSilent(state_status_, meadow_.replica.stamp(), now);
  }

 private:
  void takeLayout(const GrassLayout& message);
  void takeWind(const WindField& message);
  void takeState(const GrassState& message);
  void notePressed(const grass::TreadDelta& treads);

  MeadowReplica meadow_;
  wind::Field wind_;
  int layouts_{0}, changes_{0};
  std::set<std::pair<int, int>> pressed_;
  std::string frame_;
  InputStatus layout_status_, wind_status_, state_status_;
  ros::Subscriber layout_subscriber_, wind_subscriber_, state_subscriber_;
};

}  // namespace vegetation_sim::view
