// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "rviz/ground/shadow_painter.h"

namespace vegetation_sim::view {

/// Shadows on a plot that follow the motion of the trees nearest to the viewer; those of others are
/// at rest. The work is divided among calls. It uses no Ogre.
class MovingShadows {
 public:
  /// Largest number of balls of the trees that move; the nearest tree may exceed it.
  static constexpr std::size_t MOST_DROPS = 60000;

  /// @param tree_set,terrain have to outlive the object.
  MovingShadows(const TreeSet& tree_set, const terrain::HeightMap& terrain, const Vec3& to_sun);

  const Plot& plot() const { return plot_; }
  int edge() const { return edge_; }  ///< of the plot [pixel]

  /// Lets the trees nearest to the viewer move, once he has gone far.
  void follow(const Vec3& viewer);
  /// Paints trees as they are at `stamp` for about `seconds`, at least one. @return true when the
  /// shadows of all have been painted; the next call begins anew, unless all are of this stamp.
  bool paint(const forest::ForestReplica& replica, Nanoseconds stamp, double seconds);
  /// Returns whether all shadows of light() are of `stamp`.
  bool isComplete(Nanoseconds stamp) const { return done_ == stamp; }
  /// Returns the pixels that have changed since the last call.
  Window takeChanged();
  /// Returns the share of sunlight that reaches each pixel of the plot, south first, as of the last
  /// completed paint().
  const std::vector<float>& light() const { return light_; }
  std::size_t movingTrees() const { return near_.size(); }

 private:
  void dropNear(double depth);
  Extent shadowOf(const DrawnTree& tree) const;

  const TreeSet& tree_set_;
  Vec3 to_sun_;
  Plot plot_;
  int edge_;
  ShadowPainter rest_;   // of the trees that do not move
  ShadowPainter moved_;  // of all, while they are painted
  std::vector<const DrawnTree*> near_;
  std::size_t painted_{0};            // of near_
  Nanoseconds first_{-1}, done_{-1};  // stamps of the first tree, and of all trees of light_ or -1
  Window window_, changed_;
  bool selected_{false};
  Vec3 selected_at_{Vec3::Zero()};
  std::vector<float> light_;
};

}  // namespace vegetation_sim::view
