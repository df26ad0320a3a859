// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2_ros/buffer.h>

#include <map>
#include <string>
#include <vector>

#include "core/archive/archive.h"
#include "crowd/body/walker.h"
#include "ros/services/frame_lookup.h"
#include "ros/services/missing_inputs.h"

namespace vegetation_sim {

/// Follows the frames of robots among the walkers in tf, once per tick. A replay needs no tf, since
/// changes of robots are events.
class CrowdRobots {
 public:
  /// A robot whose newest transform is older than this is removed [s].
  static constexpr double STALE = 0.5;

  /// `buffer` must outlive it. @param wait for the transforms of a tick [s], see FrameLookup.
  CrowdRobots(std::string frame_id, std::vector<crowd::Robot> robots, const tf2_ros::Buffer& buffer,
              double wait);

  struct Change {
    bool gone{false};
    crowd::Robot robot;
  };
  /// Returns robots that moved, came or went since the last call. One whose pose is not finite is
  /// gone.
  std::vector<Change> update(Nanoseconds now);
  /// A robot at its last transform.
  struct Sample {
    Nanoseconds stamp{0};
    crowd::Point position{}, velocity{};
    double yaw{0.0};
  };
  /// The robots that are known, by frame.
  using Seen = std::map<std::string, Sample>;
  Seen seen() const;
  /// Continues from these; others are unknown, as are frames that it does not follow.
  void restore(const Seen& seen);
  static void archive(Archive& a, Seen& seen);

  /// Transforms that the last update missed.
  MissingInputs& missing() { return missing_; }
  /// Number of transforms that have not come in time for their tick.
  std::size_t late() const { return lookup_.late(); }
  /// Forgets all transforms, after a jump of time.
  void clear();

 private:
  struct Followed {
    crowd::Robot robot;
    Nanoseconds stamp{0};
    bool known{false};
  };
  bool sample(Followed& followed, Nanoseconds now, bool& moved);

  std::string frame_id_;
  std::vector<Followed> followed_;
  FrameLookup lookup_;
  MissingInputs missing_;
};

}  // namespace vegetation_sim
