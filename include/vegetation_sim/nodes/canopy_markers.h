// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "vegetation_sim/canopy/foliage.h"
#include "vegetation_sim/ros/leafed_crowns.h"

namespace vegetation_sim {

/// Leaves (id 0), rigid stems (id 1), the shade on the ground (id 2) and leaves of the forest's
/// crowns, if the layout asks for any (id 3), as TRIANGLE_LISTs of constant size, which rviz
/// updates in place. Plants share the budget in proportion to their leaves; what it does not hold
/// is left out, an even part of each plant. Degenerate triangles fill up.
class CanopyMarkers {
 public:
  /// @param points of all lists together, at least 600.
  explicit CanopyMarkers(int points);

  /// Grows the plants of a layout, as far as they will be drawn.
  void setLayout(const canopy::Layout& layout);
  /// Leaves of the forest's crowns that the same layout asks for.
  void setCrowns(const canopy::Layout& layout, const LeafedCrowns& crowns);
  /// How many of a plant's leaves are drawn: the first ones.
  std::size_t drawnOf(std::size_t leaves) const;
  /// The leaves where `foliage` carries them, and those of the crowns, crown by crown the drawn
  /// ones, where they are.
  visualization_msgs::MarkerArray build(const canopy::Foliage& foliage,
                                        const std::vector<canopy::MovedLeaf>& crowns,
                                        const std::string& frame_id);
  /// Points in use at the last build.
  std::size_t points() const { return used_; }
  std::size_t budget() const { return leaf_points_ + stem_points_ + shade_points_; }

 private:
  struct Drawn {
    canopy::Leaf leaf;
    std::size_t plant;
    std_msgs::ColorRGBA colour;
  };
  void addPlant(const canopy::Layout& layout, std::size_t id);
  void addShade(const canopy::Plant& plant, double radius);
  void addStems(const std::vector<canopy::Stem>& stems, const Vec3& colour);

  std::size_t leaf_points_, stem_points_, shade_points_, used_{0};
  std::size_t crown_points_{0};  // of leaf_points_
  double share_{1.0};            // of all leaves that will be drawn
  std::vector<Drawn> leaves_, crown_leaves_;
  visualization_msgs::Marker leaf_list_, stem_list_, shade_list_, crown_list_;
};

}  // namespace vegetation_sim
