// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2_ros/buffer.h>
#include <vegetation_sim/SensorInterest.h>

#include <string>
#include <vector>

#include "core/lod/interest_regions.h"
#include "nodes/listeners/announcements.h"
#include "vegetation_sim/core/lod/viewpoint.h"

namespace vegetation_sim {

/// Returns what viewers see. @param range of each [m]; 0: there is no limit.
std::vector<InterestArea> discsOf(const std::vector<Viewpoint>& viewers, double range);

/// The sensors that have announced themselves, for nodes whose state does not depend on them.
class SensorRegistry {
 public:
  static constexpr std::size_t MOST = Announcements<InterestArea>::MOST;
  /// How far a sensor moves until its next message is heard, and people and plants reach beyond
  /// their place [m].
  static constexpr double REACH = 10.0;

  /// @param stamp of the node's clock, 0 before it has begun. @throws InvalidInput for an invalid
  /// sensor, an unknown frame, or more than MOST sensors.
  void hear(const SensorInterest& message, const tf2_ros::Buffer& buffer,
            const std::string& frame_id, Nanoseconds stamp);
  /// Returns what the sensors meet, in order of ids, without silent sensors.
  std::vector<InterestArea> discsAt(Nanoseconds stamp) { return discs_.at(stamp); }
  std::size_t size() const { return discs_.size(); }
  void clear() { discs_.clear(); }

 private:
  Announcements<InterestArea> discs_;
};

}  // namespace vegetation_sim
