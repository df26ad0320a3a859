// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::crowd {

enum class HairCut { SHORT, CROP, BALD, LONG, BOB, TAIL, CAP, COUNT };
/// What is worn below the waist; a coat hides it as far as the knees.
enum class Outfit { TROUSERS, SHORTS, SKIRT, COAT, COUNT };
/// Where tops have their second colour: nowhere, in stripes, over the shoulders, or in front, where
/// a jacket is open.
enum class Pattern { PLAIN, STRIPES, YOKE, OPEN };
enum class Neckline { ROUND, OPEN, HIGH };

/// Appearance of a person. Colours are red, green, blue in 0 to 1.
struct Clothes {
  Vec3 skin, hair, shirt, second, trousers, shoes, soles;
  bool long_sleeves{false}, tucked{false};
  HairCut cut{HairCut::SHORT};
  Outfit outfit{Outfit::TROUSERS};
  Pattern pattern{Pattern::PLAIN};
  Neckline neckline{Neckline::ROUND};
  double beard{0.0};     ///< share of the hair's colour around the mouth
  double build{0.5};     ///< 0: broad hips; 1: broad shoulders
  double fullness{0.5};  ///< 0: slim; 1: stout
};

/// Returns the clothes of an id, equal in every process.
Clothes clothesOf(std::uint32_t id);

/// Returns the colour of a limb, given by its index in a Skeleton.
const Vec3& colourOf(const Clothes& clothes, std::size_t limb);

}  // namespace vegetation_sim::crowd
