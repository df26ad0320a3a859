// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2_ros/buffer.h>
#include <vegetation_sim/Viewer.h>

#include <string>
#include <vector>

#include "nodes/listeners/announcements.h"
#include "vegetation_sim/core/lod/viewpoint.h"

namespace vegetation_sim {

/// The viewers of what a node draws, for nodes whose state does not depend on them.
class ViewerRegistry {
 public:
  static constexpr std::size_t MOST = Announcements<Viewpoint>::MOST;

  /// @param stamp of the node's clock, 0 before it has begun. @throws InvalidInput for an invalid
  /// viewer, an unknown frame, or more than MOST viewers.
  void hear(const Viewer& message, const tf2_ros::Buffer& buffer, const std::string& frame_id,
            Nanoseconds stamp);
  /// Returns the viewpoints in order of ids, without those of silent viewers.
  std::vector<Viewpoint> eyesAt(Nanoseconds stamp) { return eyes_.at(stamp); }
  std::size_t size() const { return eyes_.size(); }
  void clear() { eyes_.clear(); }

 private:
  Announcements<Viewpoint> eyes_;
};

}  // namespace vegetation_sim
