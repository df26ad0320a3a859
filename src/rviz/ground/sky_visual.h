// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreSceneNode.h>

#include "rviz/render/batch.h"
#include "rviz/render/material.h"
#include "rviz/render/texture.h"

namespace vegetation_sim::view {

/// A dome with the sky's picture, drawn behind all else. Render thread only.
class SkyVisual {
 public:
  SkyVisual(Ogre::SceneNode& parent, const Daylight& daylight);
  ~SkyVisual();

  /// Keeps the dome around the eye; both in the frame of the parent.
  void follow(const Vec3& eye);

 private:
  Ogre::SceneNode* node_;  // Ogre's; destroyed by us
  Texture texture_;
  Material material_;
  Batch dome_;
};

}  // namespace vegetation_sim::view
