// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "vegetation_sim/canopy/foliage.h"

namespace vegetation_sim {

/// Leaves (id 0) and rigid stems (id 1) as two TRIANGLE_LISTs of constant size, which rviz updates
/// in place. Plants share the budget in proportion to their leaves; what it does not hold is left
/// out, an even part of each plant. Degenerate triangles fill up.
class CanopyMarkers {
 public:
  /// @param points of both lists together, at least 600.
  explicit CanopyMarkers(int points);

  /// Grows the plants of a layout, as far as they will be drawn.
  void setLayout(const canopy::Layout& layout);
  /// The leaves where `foliage` carries them.
  visualization_msgs::MarkerArray build(const canopy::Foliage& foliage,
                                        const std::string& frame_id);
  /// Points in use at the last build.
  std::size_t points() const { return used_; }
  std::size_t budget() const { return leaf_points_ + stem_points_; }

 private:
  struct Drawn {
    canopy::Leaf leaf;
    std::size_t plant;
    std_msgs::ColorRGBA colour;
  };
  void addPlant(const canopy::Layout& layout, std::size_t id, double share);
  void addStems(const std::vector<canopy::Stem>& stems, const Vec3& colour);

  std::size_t leaf_points_, stem_points_, used_{0};
  std::vector<Drawn> leaves_;
  visualization_msgs::Marker leaf_list_, stem_list_;
};

}  // namespace vegetation_sim
