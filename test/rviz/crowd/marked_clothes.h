// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "crowd/body/clothes.h"

namespace vegetation_sim::view {

constexpr double TALL = 1.7;  // [m]

/// Returns somebody in black, whose skin is green and whose hair is blue.
inline crowd::Clothes markedClothes(crowd::HairCut cut, crowd::Outfit outfit) {
  crowd::Clothes out;
  out.shirt = out.second = out.trousers = out.shoes = out.soles = Vec3::Zero();
  out.skin = Vec3::UnitY();
  out.hair = Vec3::UnitZ();
  out.cut = cut;
  out.outfit = outfit;
  out.long_sleeves = true;
  return out;
}

}  // namespace vegetation_sim::view
