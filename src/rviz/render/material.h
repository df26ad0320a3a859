// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreMaterial.h>

#include <string>
#include <vector>

#include "rviz/textures/sky_texture.h"

namespace vegetation_sim::view {

/// Air between the eye and what it sees.
struct Haze {
  float start{60.f}, end{420.f};  ///< [m] from nothing to most
  float most{0.f};                ///< 0: none; 1: all is the haze's colour
};

/// Materials of plants, grass and ground: a GLSL technique with our own daylight, and a
/// fixed-function one for renderers without GLSL, which takes rviz's light. Gone with this object.
/// Render thread only.
class Material {
 public:
  enum class Kind { BARK, LEAVES, GROUND, SKY, BLADES, STRIPS, SHADOWS };

  /// @param textures names: the picture, for the ground also its grain; none for blades of grass.
  /// @param fades bark and leaves only: draws by VertexPaint::fade.
  Material(Kind kind, const std::string& name, const std::vector<std::string>& textures,
           bool fades = false);
  ~Material();
  Material(const Material&) = delete;
  Material& operator=(const Material&) = delete;

  const std::string& name() const { return name_; }
  /// @param to_sun in the frame of the objects that carry the material.
  void light(const Daylight& daylight, const Vec3& to_sun, const Haze& haze);
  /// Where it fades: the clock of VertexPaint::fade; each fade takes 1 of it.
  void setFadeClock(float clock);
  /// Ground only: up to this distance [m] the picture's alpha darkens it; 0, as at first: nowhere.
  void darken(float distance);

 private:
  void addShaded(const std::vector<std::string>& textures);
  void addPlain(const std::vector<std::string>& textures);
  void addTextures(Ogre::Pass& pass, const std::vector<std::string>& textures) const;

  Kind kind_;
  bool fades_;
  std::string name_;
  Ogre::MaterialPtr material_;
  std::vector<std::string> programs_;
};

}  // namespace vegetation_sim::view
