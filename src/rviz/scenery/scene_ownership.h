// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace Ogre {
class SceneManager;
}
namespace rviz {
class Display;
}

namespace vegetation_sim::view {

/// Parts that a scene has once, although several displays could provide them.
enum class Shared { GROUND, SKY, AIR, VIEWER };

/// The request of a display to provide such a part. The request with the highest rank is granted,
/// among equals the oldest; when it is withdrawn, the next one is granted. Render thread only.
class SceneOwnership {
 public:
  /// @param key separates parts of one kind: the ground's terrain, the viewer's topic.
  SceneOwnership(const Ogre::SceneManager& scene, Shared thing, std::uint64_t key, int rank,
                 const rviz::Display& display);
  ~SceneOwnership();
  SceneOwnership(const SceneOwnership&) = delete;
  SceneOwnership& operator=(const SceneOwnership&) = delete;

  std::uint64_t key() const { return key_; }
  bool holds() const { return &holder() == this; }
  /// Returns the display that provides the part.
  const rviz::Display& giver() const { return holder().display_; }

 private:
  const SceneOwnership& holder() const;

  const Ogre::SceneManager& scene_;
  Shared thing_;
  std::uint64_t key_;
  int rank_;
  const rviz::Display& display_;
};

}  // namespace vegetation_sim::view
