// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "crowd/body/clothes.h"

namespace vegetation_sim::view {

/// The cover of a place of a body.
enum class Cover : std::uint8_t {
  SKIN,
  LIPS,
  LIP_LINE,   ///< between the lips
  MOUSTACHE,  ///< or the upper lip
  BEARD,
  BROW,
  EYE,
  IRIS,
  LASHES,
  HAIR,
  HAT,
  SHIRT,
  STRIPE,  ///< band around the trunk
  YOKE,    ///< over the shoulders
  FRONT,   ///< of SHIRT, where jackets are open; the next two of STRIPE and YOKE
  STRIPE_FRONT,
  YOKE_FRONT,
  LAPEL,  ///< of SHIRT, beside the front; the next two of STRIPE and YOKE
  STRIPE_LAPEL,
  YOKE_LAPEL,
  THROAT,  ///< where collars are open
  NOTCH,   ///< between the ends of a collar
  COLLAR,
  HEM,  ///< below the belt
  HEM_FRONT,
  UNDER_HEM,  ///< of trousers, in its shade
  BELT,
  SLEEVE,  ///< below short sleeves
  CUFF,
  SKIRT,  ///< also coats
  TROUSERS,
  SHANK,  ///< below shorts and skirts
  SOCKS,
  SHOES,
  SOLES,
  COUNT
};
constexpr std::size_t COVERS = static_cast<std::size_t>(Cover::COUNT);

using CoverColours = std::array<Vec3, COVERS>;
/// Returns the colour of each cover.
CoverColours coverColours(const crowd::Clothes& clothes);

/// Returns whether a cover has folds.
bool isCloth(Cover cover);

}  // namespace vegetation_sim::view
