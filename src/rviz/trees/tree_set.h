// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "rviz/trees/drawn_tree.h"

namespace vegetation_sim::view {

/// Camera of a view, in the layout's frame.
struct View {
  forest::Viewpoint eye;
  Vec3 forward{Vec3::UnitX()};  ///< unit
  double half_angle{0.6};       ///< of a cone around the picture [rad]
  double half_width{0.53};      ///< tangents of half of the angles of view
  double half_height{0.4};

  bool sees(const Vec3& centre, double radius) const;
};

/// Bounding box of the drawn trees, layout's frame [m].
struct Extent {
  Vec3 low{Vec3::Zero()}, high{Vec3::Zero()};
};

/// Returns the ids of the `most` trees nearest to a point, ascending; all if there are no more.
std::vector<std::uint32_t> nearestTrees(const forest::Layout& layout, const Vec3& point,
                                        std::size_t most);

/// The trees that a display draws, grown a few at a time, and the light among them. It uses no
/// Ogre.
class TreeSet {
 public:
  /// Selects trees of the replica's layout.
  TreeSet(const forest::ForestReplica& replica, std::vector<std::uint32_t> ids);

  /// Grows trees for about `seconds`; when all are grown, computes the light among them.
  /// @param leaves whether leaves block light. @return true once everything is ready.
  bool grow(const forest::ForestReplica& replica, const Vec3& to_sun, bool leaves, double seconds);
  bool ready() const { return light_ != nullptr; }

  std::size_t wanted() const { return ids_.size(); }
  const std::vector<std::unique_ptr<DrawnTree>>& trees() const { return trees_; }
  /// Returns null if the tree is not selected.
  const DrawnTree* find(std::uint32_t id) const;
  const Vec3& origin() const { return origin_; }
  const Extent& extent() const { return extent_; }
  bool hasLeaves() const { return leaves_; }
  /// @pre ready()
  const forest::LightGrid& light() const { return *light_; }
  std::shared_ptr<const forest::LightGrid> lightGrid() const { return light_; }

 private:
  void castLight(const Vec3& to_sun, bool leaves);

  std::vector<std::uint32_t> ids_;
  Vec3 origin_;
  std::vector<std::unique_ptr<DrawnTree>> trees_;
  Extent extent_;
  bool leaves_{true};
  std::shared_ptr<const forest::LightGrid> light_;
};

}  // namespace vegetation_sim::view
