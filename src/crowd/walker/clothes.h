// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::crowd {

/// Colours of a person: red, green, blue in 0 to 1.
struct Clothes {
  Vec3 skin, hair, shirt, trousers, shoes;
};

/// By id, so that a person keeps them in every picture.
Clothes clothesOf(std::uint32_t id);

/// Of a limb, an index into a Skeleton.
const Vec3& colourOf(const Clothes& clothes, std::size_t limb);

}  // namespace vegetation_sim::crowd
