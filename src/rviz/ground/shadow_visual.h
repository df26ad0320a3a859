// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreSceneNode.h>

#include <memory>

#include "rviz/ground/moving_shadows.h"
#include "rviz/render/batch.h"
#include "rviz/render/material.h"
#include "rviz/render/texture.h"

namespace vegetation_sim::view {

/// Shadows of a forest on the ground: a dark transparent surface at the height of grass. Render
/// thread only.
class ShadowVisual {
 public:
  /// @param parent scene node in the frame of the layout.
  ShadowVisual(Ogre::SceneNode& parent, const TreeSet& tree_set, const terrain::HeightMap& terrain,
               const Daylight& daylight);
  /// The shadows follow the trees by update(). @param moving draws into the texture.
  ShadowVisual(Ogre::SceneNode& parent, const TreeSet& tree_set, const terrain::HeightMap& terrain,
               std::unique_ptr<MovingShadows> moving);
  ~ShadowVisual();

  /// Moves the shadows on, for some milliseconds. Does nothing for shadows at rest.
  void update(const forest::ForestReplica& replica, Nanoseconds stamp, const Vec3& viewer);

  /// Returns whether shadows are of an earlier stamp than that of the last update().
  bool isLate() const { return late_; }

  void light(const Daylight& daylight, const Haze& haze);

 private:
  ShadowVisual(Ogre::SceneNode& parent, const TreeSet& tree_set, const terrain::HeightMap& terrain,
               const Image& picture, std::unique_ptr<MovingShadows>&& moving);
  Ogre::SceneNode* node_;                  // owned by Ogre, destroyed in the destructor
  std::unique_ptr<MovingShadows> moving_;  // null: at rest
  bool late_{false};
  Texture texture_;
  Material material_;
  Batch overlay_;
};

}  // namespace vegetation_sim::view
