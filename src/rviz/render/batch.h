// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreHardwareVertexBuffer.h>
#include <OgreSimpleRenderable.h>

#include <cstdint>
#include <string>
#include <vector>

#include "rviz/render/vertex_paint.h"

namespace vegetation_sim::view {

/// Triangles in one draw call. Positions may change each frame; everything else is fixed until the
/// next build(). It detaches itself from its scene node when destroyed. Render thread only.
class Batch : public Ogre::SimpleRenderable {
 public:
  /// @param name of the Ogre object, unique. @param material that exists.
  Batch(const std::string& name, const std::string& material);
  ~Batch() override;

  /// Changes to another existing material.
  void wear(const std::string& material);
  /// Replaces the triangles. `positions` [3 per vertex], `triangles` [3 per triangle] indices. An
  /// empty list draws nothing.
  void build(const std::vector<float>& positions, const std::vector<VertexPaint>& paint,
             const std::vector<std::uint32_t>& triangles, float margin);
  /// Adds the anchors of the leaves to the vertices of build() [3 per vertex]: layered materials
  /// draw those in one layer.
  void setAnchors(const std::vector<float>& anchors);
  /// Draws the triangles of another batch, which are stored once. Only limit() may change them
  /// here.
  void share(const Batch& other);
  std::size_t triangleCount() const;
  /// Moves the vertices of build(); they may leave its bounding box by `margin` [m].
  void move(const std::vector<float>& positions);
  /// Draws only the first triangles of build(); positions of the others need not be given.
  void limit(std::size_t triangles);
  /// Draws the triangles of build() in another order.
  void reorder(const std::vector<std::uint32_t>& triangles);
  /// Changes colours, texture coordinates and normals of the vertices of build().
  void paint(const std::vector<VertexPaint>& paint);

  /// Returns whether any camera has seen it since the last call.
  bool takeSeen();
  /// Orders the batches: the nearest are drawn first, so that the depth test rejects hidden pixels
  /// early. All batches are drawn before the transparent objects of rviz.
  void setRank(int rank);
  static constexpr int LAST_RANK = 400;

  void _notifyCurrentCamera(Ogre::Camera* camera) override;
  void _updateRenderQueue(Ogre::RenderQueue* queue) override;
  void postRender(Ogre::SceneManager* scene, Ogre::RenderSystem* renderer) override;
  Ogre::Real getBoundingRadius() const override;
  Ogre::Real getSquaredViewDepth(const Ogre::Camera* camera) const override;

 private:
  void clear();
  void setBox(const std::vector<float>& positions, float margin);

  Ogre::HardwareVertexBufferSharedPtr positions_, paint_, anchors_;
  bool seen_{true}, in_view_{true};
};

}  // namespace vegetation_sim::view
