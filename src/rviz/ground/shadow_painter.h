// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "rviz/ground/ground_texture.h"

namespace vegetation_sim::view {

/// Receives a ball of leaves or wood: centre in the layout's frame [m], radius [m], optical depth
/// through its middle; a negative depth takes a ball away again.
using ShadowDrop = std::function<void(const Vec3& at, double radius, double depth)>;

/// Accumulates the optical depth between the sun and each pixel of a window of a plot.
class ShadowPainter {
 public:
  /// @param edge of the plot [pixel]. @param terrain has to outlive the object.
  ShadowPainter(const Plot& plot, int edge, const Window& window, const terrain::HeightMap& terrain,
                const Vec3& to_sun);

  /// Adds the shadow of a ball.
  void drop(const Vec3& at, double radius, double depth);
  /// Returns the optical depths [rows x columns], south first.
  const std::vector<float>& depths() const { return depths_; }
  void setDepths(const std::vector<float>& depths) { depths_ = depths; }
  /// Returns the shares of sunlight that are left, in the same order.
  std::vector<float> light() const;

 private:
  Plot plot_;
  int edge_;
  Window window_;
  const terrain::HeightMap& terrain_;
  Vec3 slope_;
  std::vector<float> depths_;
};

/// Drops the balls of a tree in a pose. @param poses of its branches in the tree's frame; empty:
/// at rest. @param depth factor on the optical depths.
void dropTree(const DrawnTree& tree, const std::vector<Pose>& poses, bool leaves, double depth,
              const ShadowDrop& drop);
/// Counts the balls of a tree.
std::size_t countDrops(const DrawnTree& tree, bool leaves);

/// Returns the share of sunlight that balls leave to each pixel of a window, south first.
std::vector<float> castShadows(const Plot& plot, int edge, const Window& window,
                               const terrain::HeightMap& terrain, const Vec3& to_sun,
                               const std::function<void(const ShadowDrop&)>& report);
/// Returns the share of sunlight that trees at rest leave to each pixel of the plot; it resolves
/// their shadows better than the light grid. [edge x edge], south first.
std::vector<float> shadowsOn(const Plot& plot, int edge, const TreeSet& tree_set,
                             const terrain::HeightMap& terrain, const Vec3& to_sun);

/// Paints a window of a dark overlay on a plot, north at the top; its alpha is least in full light.
/// It fades out towards the border of the plot, beyond which nothing is in shadow.
/// @param light of the whole plot, as castShadows().
Image overlayPicture(const std::vector<float>& light, int edge, const Window& window);

}  // namespace vegetation_sim::view
