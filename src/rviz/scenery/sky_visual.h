// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreSceneNode.h>

#include "rviz/render/batch.h"
#include "rviz/render/material.h"
#include "rviz/render/texture.h"

namespace vegetation_sim::view {

/// A textured dome, drawn behind everything else. Render thread only.
class SkyVisual {
 public:
  SkyVisual(Ogre::SceneNode& parent, const Daylight& daylight);
  ~SkyVisual();

  /// Centres the dome on the camera; both are in the frame of the parent.
  void follow(const Vec3& eye);

 private:
  Ogre::SceneNode* node_;  // owned by Ogre, destroyed in the destructor
  Texture texture_;
  Material material_;
  Batch dome_;
};

}  // namespace vegetation_sim::view
