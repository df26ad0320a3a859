// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2_ros/buffer.h>

#include <map>
#include <string>
#include <vector>

#include "crowd/walker/walker.h"

namespace vegetation_sim {

/// Robots among the walkers, where tf has them now. The node asks at each tick; nobody else looks
/// up tf for them, so that a bag of events replays.
class CrowdRobots {
 public:
  /// A frame that tf has not moved for this long is no robot any more [s].
  static constexpr double STALE = 0.5;

  /// `buffer` must outlive it.
  CrowdRobots(std::string frame_id, std::vector<crowd::Robot> robots,
              const tf2_ros::Buffer& buffer);

  struct Change {
    bool gone{false};
    crowd::Robot robot;
  };
  /// Robots that moved, came or went since the last call; a pose that is no number is gone.
  std::vector<Change> update(Nanoseconds now);
  /// Frames that tf did not know, or not of late, at the last update.
  const std::vector<std::string>& missing() const { return missing_; }
  /// Time jumped.
  void clear();

 private:
  struct Followed {
    crowd::Robot robot;
    Nanoseconds stamp{0};
    bool known{false};
  };
  bool sample(Followed& followed, Nanoseconds now, bool& moved) const;

  std::string frame_id_;
  std::vector<Followed> followed_;
  const tf2_ros::Buffer& buffer_;
  std::vector<std::string> missing_;
};

}  // namespace vegetation_sim
