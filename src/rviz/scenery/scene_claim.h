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

/// What a scene has but once, however many displays could give it.
enum class Shared { GROUND, SKY, AIR, VIEWER };

/// A display's wish to give it. The highest rank holds it, the oldest among equals; when that one
/// goes, the next does. Render thread only.
class SceneOwnership {
 public:
  /// @param key claims of different keys do not meet: the ground's terrain, the viewer's topic.
  SceneOwnership(const Ogre::SceneManager& scene, Shared thing, std::uint64_t key, int rank,
                 const rviz::Display& display);
  ~SceneOwnership();
  SceneOwnership(const SceneOwnership&) = delete;
  SceneOwnership& operator=(const SceneOwnership&) = delete;

  std::uint64_t key() const { return key_; }
  bool holds() const { return &holder() == this; }
  /// Who gives it.
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
