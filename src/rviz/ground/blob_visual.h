// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreSceneNode.h>

#include <string>
#include <vector>

#include "rviz/ground/blob_shadow.h"
#include "rviz/render/grass_batch.h"
#include "rviz/render/material.h"
#include "rviz/render/texture.h"

namespace vegetation_sim::view {

/// Draws soft shadows on the ground in one batch, and shares them with the plants that other
/// displays draw there. Render thread only.
class BlobVisual {
 public:
  /// @param parent node in the frame of the shadows.
  explicit BlobVisual(Ogre::SceneNode& parent);
  ~BlobVisual();
  BlobVisual(const BlobVisual&) = delete;
  BlobVisual& operator=(const BlobVisual&) = delete;

  void light(const Daylight& daylight, const Haze& haze);
  /// Replaces all shadows. @param frame of the shadows.
  void fill(std::vector<BlobShadow> shadows, const std::string& frame,
            const terrain::HeightMap& terrain);
  std::size_t triangleCount() const { return mesh_.indices.size() / 3; }

  /// Returns the shadows of all displays of a scene that are in this frame. They are valid until
  /// one of them is filled or destroyed.
  static std::vector<const BlobShadow*> shadowsOf(const Ogre::SceneManager* scene,
                                                  const std::string& frame);

 private:
  Ogre::SceneNode* node_;  // Ogre's; destroyed by us
  Texture texture_;
  Material material_;
  GrassBatch batch_;
  grass::GrassMesh mesh_;
  std::vector<BlobShadow> shadows_;
  std::string frame_;
};

}  // namespace vegetation_sim::view
