// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "rviz/ground/blob_visual.h"

namespace rviz {
class Display;
class DisplayContext;
class DisplayGroup;
}  // namespace rviz

namespace vegetation_sim::view {

/// Shadows on the ground of the robot models and markers that rviz draws: of each opaque mesh or
/// shape the contact shadow below it and its shadow in sunlight. Render thread only.
class RobotShadows {
 public:
  /// @param node in the frame of the ground.
  explicit RobotShadows(Ogre::SceneNode& node) : node_(node), blobs_(node) {}

  /// @param frame name of the frame of the ground.
  void update(rviz::DisplayContext& context, const std::string& frame,
              const terrain::HeightMap& terrain, const Daylight& daylight, const Haze& haze);
  std::size_t triangleCount() const { return blobs_.triangleCount(); }

 private:
  Ogre::SceneNode& node_;
  BlobVisual blobs_;
};

}  // namespace vegetation_sim::view
