// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "crowd/body/clothes.h"
#include "sensors/geometry/rod.h"

namespace vegetation_sim::scan {

/// Place on the surface of a limb.
struct LimbPlace {
  std::size_t limb{0};         ///< index in a Skeleton
  double along{0.0};           ///< share of the way from the limb's base to its tip
  Vec3 normal{Vec3::UnitZ()};  ///< of the surface
  Vec3 front{Vec3::UnitX()};   ///< unit, horizontal direction of the face
};

/// Returns the colour of a person in sRGB: clothes with their pattern, bare hands, hair and a face.
Vec3 personColour(const crowd::Clothes& clothes, const LimbPlace& place);

/// Returns the front of a person whose shoulders are a rod from left to right.
Vec3 frontOf(const Rod& shoulders);

}  // namespace vegetation_sim::scan
