// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreColourValue.h>
#include <OgreSceneManager.h>

#include "rviz/render/material.h"

namespace rviz {
class RenderPanel;
}

namespace vegetation_sim::view {

/// Haze over everything that rviz draws, and its colour as the background. The destructor restores
/// the previous settings. Render thread only.
class Fog {
 public:
  /// @param panel may be null; the background then stays as it is.
  Fog(Ogre::SceneManager& scene, rviz::RenderPanel* panel, const Haze& haze, const Rgba& colour);
  ~Fog();
  Fog(const Fog&) = delete;
  Fog& operator=(const Fog&) = delete;

 private:
  Ogre::SceneManager& scene_;
  rviz::RenderPanel* panel_;
  Ogre::FogMode mode_;
  Ogre::ColourValue colour_, background_;
  Ogre::Real density_, start_, end_;
};

}  // namespace vegetation_sim::view
