// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2_ros/buffer.h>
#include <vegetation_sim/SensorInterest.h>

#include <map>
#include <string>
#include <vector>

#include "core/lod/interest_regions.h"
#include "vegetation_sim/core/lod/viewpoint.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Returns what viewers see. @param range of each [m]; 0: there is no limit.
std::vector<InterestArea> discsOf(const std::vector<Viewpoint>& viewers, double range);

/// The sensors that have announced themselves, for nodes whose state does not depend on them.
class SensorRegistry {
 public:
  static constexpr std::size_t MOST = 32;
  static constexpr double LIFE = 3.0;  ///< of a sensor without messages [s]
  /// How far a sensor moves until its next message is heard, and people and plants reach beyond
  /// their place [m].
  static constexpr double REACH = 10.0;

  /// @param stamp of the node's clock, 0 before it has begun. @throws InvalidInput for an invalid
  /// sensor, an unknown frame, or more than MOST sensors.
  void hear(const SensorInterest& message, const tf2_ros::Buffer& buffer,
            const std::string& frame_id, Nanoseconds stamp);
  /// Returns what the sensors meet, in order of ids. Forgets sensors without messages for LIFE.
  std::vector<InterestArea> discsAt(Nanoseconds stamp);
  std::size_t size() const { return announced_.size(); }
  void clear() { announced_.clear(); }

 private:
  struct Announced {
    InterestArea disc;
    Nanoseconds stamp{0};
  };
  std::map<std::string, Announced> announced_;
};

}  // namespace vegetation_sim
