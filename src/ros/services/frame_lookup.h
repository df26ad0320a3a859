// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <tf2_ros/buffer.h>

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Looks up the frames that a node follows, once per tick. Without a wait the newest transforms
/// count, so that a tick depends on which messages have come before it. With one, the tick waits
/// for the transforms at its own stamp. A frame that has none at the end of the wait counts as it
/// was last, until a tick at which it is awaited again has a transform. Those ticks follow from
/// stamps alone: the next one, and then each at which the frame has been missing for twice as long
/// as at the trial before, or for LONGEST_PAUSE or PAUSE_PER_WAIT waits more. Between them no
/// transform of the frame is looked at. So equal messages give equal ticks, whenever in the wait
/// they come, and a frame that never comes delays few ticks.
class FrameLookup {
 public:
  static constexpr double LONGEST_WAIT = 60.0;    ///< [s]
  static constexpr double LONGEST_PAUSE = 1.0;    ///< between two trials [s]
  static constexpr double PAUSE_PER_WAIT = 10.0;  ///< between two trials, if that is longer

  /// The time in which a lookup waits, and a function that lets some of it pass [s].
  struct WallClock {
    std::function<double()> now;
    std::function<void(double)> sleep;
  };
  static WallClock systemClock();

  /// @param wait wall time for which a tick waits for all of its frames together [s]; `buffer` must
  /// outlive it and be filled by another thread.
  FrameLookup(const tf2_ros::Buffer& buffer, std::string world, double wait,
              WallClock clock = systemClock());

  /// Begins a tick. After a jump back of time all frames are awaited.
  void begin(Nanoseconds tick);
  /// Returns the transform of a frame to the world at the tick, or the newest one without a wait or
  /// after it. @throws tf2::TransformException if there is none at all.
  geometry_msgs::TransformStamped find(const std::string& frame);
  /// Number of transforms that have not come in time.
  std::size_t late() const { return late_; }

 private:
  // A frame that has been awaited in vain.
  struct Missing {
    Nanoseconds since, tried, again;                      // ticks
    std::optional<geometry_msgs::TransformStamped> last;  // not later than the tick
  };

  bool awaits(const std::string& frame) const;
  std::optional<geometry_msgs::TransformStamped> newestOf(const std::string& frame) const;
  void giveUp(const std::string& frame);

  const tf2_ros::Buffer& buffer_;
  std::string world_;
  double wait_;
  WallClock clock_;
  Nanoseconds tick_{0};
  double deadline_{0.0};
  std::map<std::string, Missing> missing_;
  std::size_t late_{0};
};

}  // namespace vegetation_sim
