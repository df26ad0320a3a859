// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <vegetation_sim/AgentStates.h>

#include <optional>
#include <string>
#include <vector>

#include "crowd/walker/walker.h"
#include "rviz/ground/ground_source.h"
#include "rviz/scenery/input_status.h"

namespace vegetation_sim::view {

/// A walker as it was told.
struct Person {
  crowd::Walker walker;
  double ground{0.0};  ///< height that it stands at [m]
};

/// Listens to a crowd. Callbacks run in the queue of the node handle: for a display the render
/// thread's. A refused message changes nothing.
class CrowdSource {
 public:
  /// @throws ros::InvalidNameException for a topic that cannot be.
  CrowdSource(ros::NodeHandle nh, const std::string& topic);

  const std::vector<Person>& people() const { return people_; }
  const terrain::HeightMap& ground() const { return ground_.ground(); }
  /// Counts messages taken, 0: none yet.
  int messages() const { return messages_; }
  const std::string& frame() const { return frame_; }
  /// Time went back to `now`: who was told of a later time is no more.
  void forgetState(Nanoseconds now);
  /// To be called at rising times: whoever was not told of for 3 s is no more.
  void watch(Nanoseconds now);
  const InputStatus& status() const { return status_; }

 private:
  void take(const AgentStates& message);

  void forgetAll(const char* why);

  GroundSource ground_;
  std::vector<Person> people_;
  Nanoseconds stamp_{0}, heard_{0};
  int messages_{0}, watched_{0};
  std::string frame_;
  InputStatus status_;
  ros::Subscriber subscriber_;
};

}  // namespace vegetation_sim::view
