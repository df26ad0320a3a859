// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2_ros/buffer.h>
#include <vegetation_sim/Viewer.h>

#include <map>
#include <string>
#include <vector>

#include "vegetation_sim/core/lod/viewpoint.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// The viewers of what a node draws, for nodes whose state does not depend on them.
class ViewerRegistry {
 public:
  static constexpr std::size_t MOST = 32;
  static constexpr double LIFE = 3.0;  ///< of a viewer without messages [s]

  /// @param stamp of the node's clock, 0 before it has begun. @throws InvalidInput for an invalid
  /// viewer, an unknown frame, or more than MOST viewers.
  void hear(const Viewer& message, const tf2_ros::Buffer& buffer, const std::string& frame_id,
            Nanoseconds stamp);
  /// Returns the viewpoints in order of ids. Forgets viewers without messages for LIFE.
  std::vector<Viewpoint> eyesAt(Nanoseconds stamp);
  std::size_t size() const { return seen_.size(); }
  void clear() { seen_.clear(); }

 private:
  struct Seen {
    Viewpoint eye;
    Nanoseconds stamp{0};
  };
  std::map<std::string, Seen> seen_;
};

}  // namespace vegetation_sim
