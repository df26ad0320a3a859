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
  Plot plot;             ///< gets the picture
  const Image& picture;  ///< of the plot from above, north on top, with its light; alpha: part of
                         ///< the light that is left near the eye, where plants on it are drawn
  const terrain::HeightMap& terrain;
  Vec3 origin{Vec3::Zero()};        ///< of coordinates, layout's frame [m]
  double cell{3.0};                 ///< [m] about, of the plot's mesh on ground that is not flat
  Rgba tint{{1.f, 1.f, 1.f, 1.f}};  ///< multiplies the colour of grass
};

/// Ground: a plot with its picture, and plain land around it as far as the eye reaches. Render
/// thread only; all of it goes with this object.
class GroundVisual {
 public:
  /// @param parent node in the frame of the layout.
  GroundVisual(Ogre::SceneNode& parent, const Land& land, const Daylight& daylight);
  ~GroundVisual();

  void light(const Daylight& daylight, const Vec3& to_sun, const Haze& haze);
  /// Up to this distance [m] the picture's alpha darkens it; 0, as at first: nowhere.
  void darken(float distance) { plot_material_.darken(distance); }
  /// Paints part of the picture anew, `column` and `row` from its top left.
  void repaint(int column, int row, const Image& part) { plot_texture_.update(column, row, part); }
  std::size_t triangleCount() const { return triangles_; }

 private:
  void addPlot(const Land& land);
  void addLand(const Land& land, const Daylight& daylight);
  void add(const std::vector<float>& positions, const std::vector<VertexPaint>& paint,
           const std::vector<std::uint32_t>& triangles, const std::string& material);

  Ogre::SceneNode* node_;  // Ogre's; destroyed by us
  Texture plot_texture_, plain_texture_, grain_texture_;
  Material plot_material_, land_material_;
  std::vector<std::unique_ptr<Batch>> batches_;
  std::size_t triangles_{0};
};

/// Grass around what stands on it, for displays that know no more of the ground.
/// @param shade cast on the plot with PLAIN_EDGE pixels.
std::unique_ptr<GroundVisual> plainGround(Ogre::SceneNode& parent, const Plot& plot,
                                          const Shade& shade, const terrain::HeightMap& terrain,
                                          const Daylight& daylight, const Rgba& tint);
constexpr int PLAIN_EDGE = 512;  ///< [pixel] of its picture

}  // namespace vegetation_sim::view
