// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreHardwareVertexBuffer.h>
#include <OgreSimpleRenderable.h>

#include <string>

#include "grass/mesh/grass_geometry.h"

namespace vegetation_sim::view {

/// Triangles in one draw call that are all replaced when grass moves. It detaches itself from its
/// scene node when it is destroyed. Render thread only.
class GrassBatch : public Ogre::SimpleRenderable {
 public:
  /// @param name unique name of the OGRE object. @param material existing. @param rank as in Batch.
  GrassBatch(const std::string& name, const std::string& material, int rank);
  ~GrassBatch() override;

  /// Replaces the triangles. Positions are relative to the node.
  void fill(const grass::GrassMesh& mesh);

  void _updateRenderQueue(Ogre::RenderQueue* queue) override;
  void postRender(Ogre::SceneManager* scene, Ogre::RenderSystem* renderer) override;
  Ogre::Real getBoundingRadius() const override;
  Ogre::Real getSquaredViewDepth(const Ogre::Camera* camera) const override;

 private:
  void makeRoom(std::size_t vertices, std::size_t indices);

  Ogre::HardwareVertexBufferSharedPtr positions_, texture_, colours_;
  Ogre::HardwareIndexBufferSharedPtr indices_;
  std::size_t vertex_room_{0}, index_room_{0};
};

}  // namespace vegetation_sim::view
