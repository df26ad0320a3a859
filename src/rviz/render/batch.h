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

/// Some triangles that are drawn at once: positions that may change each frame, all else fixed.
/// Attach it to a scene node; it leaves it when destroyed. Render thread only.
class Batch : public Ogre::SimpleRenderable {
 public:
  /// @param name of the Ogre object, unique. @param material that exists.
  Batch(const std::string& name, const std::string& material);
  ~Batch() override;

  /// Another material, which exists.
  void wear(const std::string& material);
  /// New triangles. `positions` [3 per vertex], `triangles` [3 per triangle] indices. Nothing is
  /// drawn where there is no triangle.
  void build(const std::vector<float>& positions, const std::vector<VertexPaint>& paint,
             const std::vector<std::uint32_t>& triangles, float margin);
  /// Moves the vertices of build(); they may leave its bounding box by `margin` [m].
  void move(const std::vector<float>& positions);
  /// Draws the first so many triangles of build() only; positions of others need not be given.
  void limit(std::size_t triangles);
  /// Draws the triangles of build() in another order.
  void reorder(const std::vector<std::uint32_t>& triangles);
  /// Changes colours, places and normals of build()'s vertices.
  void paint(const std::vector<VertexPaint>& paint);

  /// True if any camera has seen it since the last call.
  bool takeSeen();
  /// Which batches are drawn first: the nearest, so that they hide the others cheaply. All of them
  /// come before what rviz draws itself, so that its see-through things stay in front.
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

  Ogre::HardwareVertexBufferSharedPtr positions_, paint_;
  bool seen_{true}, in_view_{true};
};

}  // namespace vegetation_sim::view
