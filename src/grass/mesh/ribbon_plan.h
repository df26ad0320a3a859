// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "grass/blades/blade_placement.h"
#include "grass/mesh/grass_geometry.h"

namespace vegetation_sim::grass {

constexpr float STUBBLE_PALENESS = 0.3f;  ///< stems are drier than leaves
constexpr float STUBBLE_SHADE = 0.4f;     ///< part of the shade of neighbours that stubble has
constexpr float HALF_HIDDEN = 0.12f;      ///< cut grass that hides half of what is below [kg/m^2]
constexpr int PETALS = 6;                 ///< corners of a flower around its middle

struct Float3 {
  float x, y, z;
};
constexpr Float3 HAY{0.66f, 0.60f, 0.33f};
inline Float3 operator+(const Float3& a, const Float3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Float3 operator-(const Float3& a, const Float3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Float3 operator*(const Float3& a, float s) {
  return {a.x * s, a.y * s, a.z * s};
}

inline Float3 toFloat3(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// Appearance of the blades of one species.
struct RibbonLook {
  Float3 fresh, drying, petal;
  float half, flower;  ///< half the width at the root, radius of the flower [m]
};

/// Variation of a blade, from its random word; each number is 0 to 1 or, for leans, -1 to 1.
struct RibbonForm {
  static constexpr float LEAN = 0.22f;          ///< of the tip, per length of the blade
  static constexpr float LENGTH_RANGE = 0.42f;  ///< of the length factor
  static constexpr float LONGEST = 1.20f, LONGEST_SIBLING = 1.12f;
  static constexpr float STRAW = 0.8f, STRAW_DRY = 1.75f;                  ///< hues above are drier
  static constexpr float COOL = 0.35f, COOL_RED = 0.6f, COOL_BLUE = 0.8f;  ///< hues below are bluer
  static constexpr float ROOT_DARK = 0.12f, TIP_BRIGHT = 0.34f;
  static constexpr float STEM = 0.45f;  ///< factor of the width below a flower or a seed head
};

/// Values that all ribbons of a tile share.
struct RibbonPlan {
  /// @param origin of the mesh, world [m].
  RibbonPlan(const FeatureMap& map, const Tile& drawn, const RibbonStyle& drawing,
             const Vec3& origin);
  /// Returns whether any species has flowers.
  bool hasFlowers() const;
  bool isVaried() const { return style.variety > 0.f; }
  /// Returns whether ribbons may have flowers or seed heads.
  bool hasTips() const { return style.sibling == 0 && (isVaried() || hasFlowers()); }
  /// Returns the first argument of mix32() for the random word of a blade, without the blade.
  std::uint32_t seed() const {
    return static_cast<std::uint32_t>(tile.key >> 32) ^ static_cast<std::uint32_t>(style.sibling)
                                                            << 28;
  }
  /// Returns the number of segments of a ribbon: 1, 2, 3 or LINKS.
  int segments() const {
    return style.segments >= 1 && style.segments <= 3 ? style.segments : LINKS;
  }
  /// Returns whether the ground of the tile has been mown.
  bool isMown() const { return style.crush && !style.crush->cut.empty(); }

  const Tile& tile;
  const RibbonStyle& style;
  Float3 corner, eye;
  TilePlan<float> plan;
  Bilinear<float> colour;
  std::array<int, POINTS> kept;   ///< the points that a ribbon of style.segments keeps, root first
  std::vector<RibbonLook> looks;  ///< per species
  float slope_x{0.f}, slope_y{0.f};  ///< mean slope of the ground
};

/// Places in reserved memory of a mesh where the next vertex and triangle go.
struct MeshPlaces {
  float* position;
  float* texture;
  std::uint8_t* colour;
  std::uint32_t* index;
  std::uint32_t next;  ///< index of the next vertex

  void vertex(const Float3& p, float u, float v, const Float3& c) {
    position[0] = p.x, position[1] = p.y, position[2] = p.z;
    texture[0] = u, texture[1] = v;
    colour[0] = byteOfUnit(c.x), colour[1] = byteOfUnit(c.y), colour[2] = byteOfUnit(c.z);
    colour[3] = 255;
    position += 3, texture += 2, colour += 4, ++next;
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    index[0] = a, index[1] = b, index[2] = c;
    index += 3;
  }
  static std::uint8_t byteOfUnit(float part) {
    constexpr float HALF = 0.5f;  // for rounding, since std::lround would call the library
    return static_cast<std::uint8_t>(255.f * std::min(1.f, std::max(0.f, part)) + HALF);
  }
};

/// Returns a colour in the light at point p of a blade. Without light a blade is dark at the root,
/// where neighbours shade it.
Float3 shadeRibbon(const RibbonPlan& plan, const Float3& own, const Float3& p, const Float3& root,
                   float way, float facing);

/// A blade with what may stand at its tip.
struct RibbonTip {
  float x, y;          ///< root, in the tile [m]
  float length;        ///< distance from root to tip [m]
  std::uint32_t dice;  ///< random word of the blade
  int kind;            ///< species
};
/// Returns the radius of the flower of a varied blade, the negative half length of its seed head,
/// or 0 [m].
float tipSize(const RibbonPlan& plan, const RibbonTip& tip);

/// Adds a disc of radius r [m] at the tip of a blade, or a seed head if r is negative. A disc faces
/// half upwards and half to the viewer; of varied blades it is tilted at random.
/// @param side unit vector across the blade. @param below a point of the blade below its tip.
void writeTip(const RibbonPlan& plan, const Float3& tip, const Float3& below, const Float3& side,
              float r, std::uint32_t dice, const RibbonLook& look, MeshPlaces& out);

}  // namespace vegetation_sim::grass
