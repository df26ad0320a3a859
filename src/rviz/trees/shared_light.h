// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "tree/mesh/light_grid.h"

namespace Ogre {
class SceneManager;
}

namespace vegetation_sim::view {

/// The light among the trees of one display, for what other displays of the scene draw there. It is
/// shared as long as the object lives. Render thread only.
class SharedLight {
 public:
  /// @param frame of the grid.
  SharedLight(const Ogre::SceneManager* scene, std::string frame,
              std::shared_ptr<const forest::LightGrid> grid);
  ~SharedLight();
  SharedLight(const SharedLight&) = delete;
  SharedLight& operator=(const SharedLight&) = delete;

  /// Shares of sunlight and skylight, 0 to 1.
  struct Shares {
    double sun{1.0}, sky{1.0};
  };
  /// Returns the light at a place in a frame, through the trees of all displays of the scene that
  /// are in this frame.
  static Shares at(const Ogre::SceneManager* scene, const std::string& frame, const Vec3& place);
  /// Number of times that light was shared, or no longer shared, in any scene.
  static int changes();

 private:
  const Ogre::SceneManager* scene_;
  std::string frame_;
  std::shared_ptr<const forest::LightGrid> grid_;
};

}  // namespace vegetation_sim::view
