// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreMaterial.h>

#include <array>
#include <string>
#include <vector>

#include "rviz/textures/sky_texture.h"

namespace vegetation_sim::view {

/// Haze between the camera and an object.
struct Haze {
  float start{60.f}, end{420.f};  ///< distances of no haze and of the most haze [m]
  float most{0.f};                ///< largest share of the haze's colour, 0 to 1
};

/// Materials of plants, grass and ground: a GLSL technique with daylight of its own, and a
/// fixed-function technique with rviz's light for renderers without GLSL. The destructor removes
/// them. Render thread only.
class Material {
 public:
  /// LAYER: the picture of a layer of leaves.
  enum class Kind { BARK, LEAVES, GROUND, SKY, BLADES, STRIPS, SHADOWS, LAYER };
  /// FADING: vertices fade by VertexPaint::fade. LAYERED: only leaves of the layer of setLayer().
  /// NEAR, and FADING: leaves near the eye go as they are seen on edge.
  enum class Variant { WHOLE, FADING, LAYERED, NEAR };
  /// Distance beyond which NEAR and WHOLE look alike [m].
  static constexpr float NEAR_END = 14.f;

  /// @param textures names of the texture and, for the ground, of its grain; none for blades.
  /// @param variant of bark and leaves.
  Material(Kind kind, const std::string& name, const std::vector<std::string>& textures,
           Variant variant = Variant::WHOLE);
  ~Material();
  Material(const Material&) = delete;
  Material& operator=(const Material&) = delete;

  const std::string& name() const { return name_; }
  /// @param to_sun direction in the frame of the objects that use the material.
  void light(const Daylight& daylight, const Vec3& to_sun, const Haze& haze);
  /// Sets the clock of VertexPaint::fade; a fade takes one unit of it.
  void setFadeClock(float clock);
  /// For layered leaves: sets the layer that is drawn. The depth is that along `axis`, and that of
  /// the scene's origin is `depth` [m]. @param depths begin and end of the layer [m].
  void setLayer(const Vec3& axis, double depth, const std::array<double, 2>& depths);
  /// For the picture of a layer: part that shows, 0 to 1; the default is 1.
  void show(float part);
  /// For the ground: up to this distance [m] the texture's alpha darkens it. The default is 0.
  void darken(float distance);

 private:
  void addShaded(const std::vector<std::string>& textures);
  void addPlain(const std::vector<std::string>& textures);
  void addTextures(Ogre::Pass& pass, const std::vector<std::string>& textures) const;

  Kind kind_;
  Variant variant_;
  std::string name_;
  Ogre::MaterialPtr material_;
  std::vector<std::string> programs_;
};

}  // namespace vegetation_sim::view
