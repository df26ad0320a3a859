// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <vegetation_sim/WindField.h>

#include <string>

#include "rviz/ground/ground_source.h"
#include "rviz/scenery/input_status.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::view {

/// Listens to the wind. Callbacks run in the queue of the node handle: for a display the render
/// thread's. A refused message changes nothing.
class WindSource {
 public:
  /// @throws ros::InvalidNameException for a topic that cannot be.
  WindSource(ros::NodeHandle nh, const std::string& topic);

  const wind::Field& wind() const { return wind_; }
  const terrain::HeightMap& ground() const { return ground_.ground(); }
  /// Counts messages taken, 0: none yet.
  int messages() const { return messages_; }
  const std::string& frame() const { return frame_; }
  const InputStatus& status() const { return status_; }

 private:
  void take(const WindField& message);

  GroundSource ground_;
  wind::Field wind_;
  int messages_{0};
  std::string frame_;
  InputStatus status_;
  ros::Subscriber subscriber_;
};

}  // namespace vegetation_sim::view
