// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreSceneNode.h>

#include "rviz/ground/ground_texture.h"
#include "rviz/render/batch.h"
#include "rviz/render/material.h"
#include "rviz/render/texture.h"

namespace vegetation_sim::view {

/// Shadows of a forest over the ground of another display: a dark transparent surface at the height
/// of grass. Render thread only.
class ShadowVisual {
 public:
  /// @param parent scene node in the frame of the layout.
  ShadowVisual(Ogre::SceneNode& parent, const TreeSet& tree_set, const terrain::HeightMap& terrain,
               const Daylight& daylight);
  ~ShadowVisual();

  void light(const Daylight& daylight, const Haze& haze);

 private:
  Ogre::SceneNode* node_;  // owned by Ogre, destroyed in the destructor
  Texture texture_;
  Material material_;
  Batch veil_;
};

}  // namespace vegetation_sim::view
