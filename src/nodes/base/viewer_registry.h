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

/// Who looks at what a node draws, where nothing that it remembers depends on it: grass, people.
class ViewerRegistry {
 public:
  static constexpr std::size_t MOST = 32;
  static constexpr double LIFE = 3.0;  ///< of a viewer that is not heard [s]

  /// @param stamp of the node's clock, 0 before it has begun. @throws InvalidInput for a bad
  /// viewer, one of an unknown frame, and one too many.
  void hear(const Viewer& message, const tf2_ros::Buffer& buffer, const std::string& frame_id,
            Nanoseconds stamp);
  /// Their eyes, by id; forgets those that are silent.
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
