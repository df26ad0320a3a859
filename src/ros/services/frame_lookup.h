// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <tf2_ros/buffer.h>

#include <cstddef>
#include <map>
#include <string>

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Looks up the frames that a node follows, once per tick. Without a wait the newest transforms
/// count, so that a tick depends on which messages have come before it. With one, the tick waits
/// for the transforms at its own stamp, so that equal messages give equal ticks. A frame that has
/// been awaited in vain is awaited again when it has another transform, so that one that never
/// comes delays one tick.
class FrameLookup {
 public:
  static constexpr double LONGEST_WAIT = 60.0;  ///< [s]

  /// @param wait wall time for which a tick waits for all of its frames together [s]; `buffer` must
  /// outlive it and be filled by another thread.
  FrameLookup(const tf2_ros::Buffer& buffer, std::string world, double wait);

  /// Begins a tick.
  void begin(Nanoseconds tick);
  /// Returns the transform of a frame to the world at the tick, or the newest one without a wait or
  /// after it. @throws tf2::TransformException if there is none at all.
  geometry_msgs::TransformStamped find(const std::string& frame);
  /// Number of transforms that have not come in time.
  std::size_t late() const { return late_; }

 private:
  bool awaits(const std::string& frame, const ros::Time& stamp);
  ros::Time newestOf(const std::string& frame) const;

  const tf2_ros::Buffer& buffer_;
  std::string world_;
  double wait_;
  Nanoseconds tick_{0};
  ros::WallTime deadline_;
  std::map<std::string, ros::Time> given_up_;  // newest stamp of frames awaited in vain
  std::size_t late_{0};
};

}  // namespace vegetation_sim
