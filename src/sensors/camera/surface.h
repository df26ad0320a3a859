// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>

#include "crowd/body/clothes.h"
#include "sensors/sensor_scene.h"

namespace vegetation_sim::scan {

/// Appearance of the object at a hit.
struct Surface {
  Vec3 normal{Vec3::UnitZ()};  ///< unit, towards the side that the ray comes from
  Vec3 albedo{Vec3::Zero()};   ///< linear red, green, blue
  double sky{1.0};             ///< share of the sky that neighbouring leaves and blades leave
  double transmits{0.0};       ///< share of the light on the far side that comes through
};

/// The surfaces of a scene, which must not change meanwhile. Colours are those of species, kinds of
/// plants and clothes. Textures belong to the place on the object and move with it.
class Surfaces {
 public:
  explicit Surfaces(const Scene& scene);
  /// @param hit of the ray on the scene; not Label::NONE.
  Surface at(const Ray& ray, const Hit& hit) const;
  /// Returns the ground at a place. @param open share of the sky that trees leave there: grass
  /// grows in the open, litter lies under trees.
  Surface groundAt(const Vec3& place, double open = 1.0) const;

 private:
  struct Person {
    std::size_t first_limb;
    crowd::Clothes clothes;
  };
  Surface woodAt(const Vec3& place, const Hit& hit) const;
  Surface leafAt(const Vec3& place, const Hit& hit) const;
  Surface grassAt(const Vec3& place) const;
  Surface plantAt(const Vec3& place, const Hit& hit) const;
  Surface personAt(const Vec3& place, const Hit& hit) const;

  const Scene& scene_;
  std::map<std::uint32_t, const PosedTree*> trees_;
  std::map<std::uint32_t, const PosedPlant*> plants_;
  std::map<std::uint32_t, Person> people_;
};

/// Returns the linear values of a colour in sRGB, 0 to 1 (IEC 61966-2-1).
Vec3 linearOf(const Vec3& srgb);

}  // namespace vegetation_sim::scan
