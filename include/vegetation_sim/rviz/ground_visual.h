// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreSceneNode.h>

#include <memory>
#include <vector>

#include "vegetation_sim/rviz/batch.h"
#include "vegetation_sim/rviz/ground_picture.h"
#include "vegetation_sim/rviz/material.h"
#include "vegetation_sim/rviz/texture.h"

namespace vegetation_sim::view {

/// The ground under a forest: the plot where the trees stand with its picture, and plain land
/// around it as far as the eye reaches. Render thread only; all of it goes with this object.
class GroundVisual {
 public:
  /// @param parent node in the frame of the layout. @param tint multiplies the colour of grass.
  GroundVisual(Ogre::SceneNode& parent, const TreeStock& stock, const terrain::HeightMap& terrain,
               const Daylight& daylight, const Rgba& tint);
  ~GroundVisual();

  void light(const Daylight& daylight, const Vec3& to_sun, const Haze& haze);
  std::size_t triangleCount() const { return triangles_; }

 private:
  void addPlot(const Plot& plot, const terrain::HeightMap& terrain, const Vec3& origin);
  void addLand(const Plot& plot, const terrain::HeightMap& terrain, const Vec3& origin,
               const Daylight& daylight, const Rgba& tint);
  void add(const std::vector<float>& positions, const std::vector<VertexPaint>& paint,
           const std::vector<std::uint32_t>& triangles, const std::string& material);

  Ogre::SceneNode* node_;  // Ogre's; destroyed by us
  Texture plot_texture_, plain_texture_, grain_texture_;
  Material plot_material_, land_material_;
  std::vector<std::unique_ptr<Batch>> batches_;
  std::size_t triangles_{0};
};

}  // namespace vegetation_sim::view
