// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::crowd {

/// Appearance of a person. Colours are red, green, blue in 0 to 1.
struct Clothes {
  Vec3 skin, hair, shirt, trousers, shoes;
  bool long_sleeves{false}, long_hair{false};
  double build{0.5};  ///< 0: broad hips; 1: broad shoulders
};

/// Returns the clothes of an id, equal in every process.
Clothes clothesOf(std::uint32_t id);

/// Returns the colour of a limb, given by its index in a Skeleton.
const Vec3& colourOf(const Clothes& clothes, std::size_t limb);

}  // namespace vegetation_sim::crowd
