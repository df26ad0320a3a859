// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "rviz/trees/drawn_tree.h"

namespace vegetation_sim::view {

/// Who looks, in the layout's frame.
struct View {
  forest::Viewpoint eye;
  Vec3 forward{Vec3::UnitX()};  ///< unit
  double half_angle{0.6};       ///< of a cone around all that is in the picture [rad]

  bool sees(const Vec3& centre, double radius) const;
};

/// Box of the trees that are drawn, layout's frame [m].
struct Extent {
  Vec3 low{Vec3::Zero()}, high{Vec3::Zero()};
};

/// Ids of the `most` trees nearest to a point, in rising order; all if there are no more.
std::vector<std::uint32_t> nearestTrees(const forest::Layout& layout, const Vec3& point,
                                        std::size_t most);

/// The trees that a display draws, grown a few at a time, and the light among them. No Ogre in it.
class TreeSet {
 public:
  /// Starts anew with some trees of the replica's layout.
  TreeSet(const forest::ForestReplica& replica, std::vector<std::uint32_t> ids);

  /// Grows trees for about `seconds`; when all stand, sends light through them.
  /// @param leaves whether they take light. @return true once all is there.
  bool grow(const forest::ForestReplica& replica, const Vec3& to_sun, bool leaves, double seconds);
  bool ready() const { return light_ != nullptr; }

  std::size_t wanted() const { return ids_.size(); }
  const std::vector<std::unique_ptr<DrawnTree>>& trees() const { return trees_; }
  /// Null if it is not among them.
  const DrawnTree* find(std::uint32_t id) const;
  const Vec3& origin() const { return origin_; }
  const Extent& extent() const { return extent_; }
  bool hasLeaves() const { return leaves_; }
  /// @pre ready()
  const forest::LightGrid& light() const { return *light_; }

 private:
  void castLight(const Vec3& to_sun, bool leaves);

  std::vector<std::uint32_t> ids_;
  Vec3 origin_;
  std::vector<std::unique_ptr<DrawnTree>> trees_;
  Extent extent_;
  bool leaves_{true};
  std::unique_ptr<forest::LightGrid> light_;
};

}  // namespace vegetation_sim::view
