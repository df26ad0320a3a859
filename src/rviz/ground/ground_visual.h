// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreSceneNode.h>

#include <memory>
#include <vector>

#include "rviz/ground/ground_texture.h"
#include "rviz/render/batch.h"
#include "rviz/render/material.h"
#include "rviz/render/texture.h"

namespace vegetation_sim::view {

/// Ground to draw.
struct Land {
  Plot plot;             ///< area of the texture
  const Image& picture;  ///< lit plot from above, north at the top; alpha is the share
                         ///< of light left near the camera, where plants are drawn
  const terrain::HeightMap& terrain;
  Vec3 origin{Vec3::Zero()};        ///< origin of coordinates, layout's frame [m]
  double cell{3.0};                 ///< approximate cell of the mesh on uneven ground [m]
  Rgba tint{{1.f, 1.f, 1.f, 1.f}};  ///< factor of the colour of grass
};

/// Ground: a textured plot, and plain land around it up to the horizon. The destructor removes it.
/// Render thread only.
class GroundVisual {
 public:
  /// @param parent scene node in the frame of the layout.
  GroundVisual(Ogre::SceneNode& parent, const Land& land, const Daylight& daylight);
  ~GroundVisual();

  void light(const Daylight& daylight, const Vec3& to_sun, const Haze& haze);
  /// Up to this distance [m] the texture's alpha darkens it. The default is 0.
  void darken(float distance) { plot_material_.darken(distance); }
  /// Replaces a part of the texture; `column` and `row` count from its top left.
  void repaint(int column, int row, const Image& part) { plot_texture_.update(column, row, part); }
  std::size_t triangleCount() const { return triangles_; }

 private:
  void addPlot(const Land& land);
  void addLand(const Land& land, const Daylight& daylight);
  void add(const std::vector<float>& positions, const std::vector<VertexPaint>& paint,
           const std::vector<std::uint32_t>& triangles, const std::string& material);

  Ogre::SceneNode* node_;  // owned by Ogre, destroyed in the destructor
  Texture plot_texture_, plain_texture_, grain_texture_;
  Material plot_material_, land_material_;
  std::vector<std::unique_ptr<Batch>> batches_;
  std::size_t triangles_{0};
};

/// Grass for displays that know nothing else of the ground.
/// @param shade light on the plot with PLAIN_EDGE pixels.
std::unique_ptr<GroundVisual> plainGround(Ogre::SceneNode& parent, const Plot& plot,
                                          const Shade& shade, const terrain::HeightMap& terrain,
                                          const Daylight& daylight, const Rgba& tint);
constexpr int PLAIN_EDGE = 512;  ///< edge of its texture [pixel]

}  // namespace vegetation_sim::view
