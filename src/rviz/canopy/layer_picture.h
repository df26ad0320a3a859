// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreCamera.h>
#include <OgreSceneNode.h>

#include <memory>
#include <string>
#include <vector>

#include "canopy/layer_grid.h"
#include "rviz/render/batch.h"
#include "rviz/render/material.h"

namespace vegetation_sim::view {

/// An Ogre texture that a camera renders into. The destructor removes it. Render thread only.
class RenderedTexture {
 public:
  /// @param width, height [pixel].
  RenderedTexture(const std::string& name, int width, int height, Ogre::Camera& camera);
  ~RenderedTexture();
  RenderedTexture(const RenderedTexture&) = delete;
  RenderedTexture& operator=(const RenderedTexture&) = delete;

  const std::string& name() const { return name_; }
  /// Renders what the camera sees: on transparent black, or over what has been rendered.
  void render(bool clear);

 private:
  std::string name_;
};

/// The picture of one layer of leaves at rest, drawn on a grid that moves as the layer does (S3-27,
/// S3-07). Render thread only.
class LayerPicture {
 public:
  /// @param grid finished. @param node with its frame at `origin` [m].
  LayerPicture(canopy::LayerGrid grid, int layer, const Vec3& origin, Ogre::SceneNode& node);

  /// Makes an empty picture. @param pixels_per_radian of the picture. @param camera in the scene of
  /// the leaves at rest.
  void open(double pixels_per_radian, Ogre::Camera& camera);
  /// Adds to the picture what the camera sees, which must be leaves of this layer alone.
  void render();
  /// Draws the picture from now on, in front of those of the layers behind it.
  void finish(int layers_behind);
  int layer() const { return layer_; }
  const canopy::LayerGrid& grid() const { return grid_; }
  /// Moves the grid with the layer.
  void move(const canopy::Foliage& foliage);
  /// Part that shows, from 0 to 1.
  void show(float part) {
    if (material_) material_->show(part);
  }

 private:
  void buildBatch();

  canopy::LayerGrid grid_;
  int layer_;
  Vec3 origin_;
  Ogre::SceneNode* node_;
  std::unique_ptr<RenderedTexture> texture_;
  bool empty_{true};
  std::unique_ptr<Material> material_;
  std::unique_ptr<Batch> batch_;
  std::vector<float> positions_;
};

}  // namespace vegetation_sim::view
