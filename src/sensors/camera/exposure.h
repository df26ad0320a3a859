// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sensors/model/ray_random.h"
#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::scan {

/// How light becomes the numbers of a picture (docs/scan.md).
struct Exposure {
  double factor{1.0};      ///< signal per radiance; a signal of 1 saturates the pixel
  double read_noise{0.0};  ///< standard deviation of a dark pixel, over the saturated signal
  double shot_noise{0.0};  ///< standard deviation of a saturated pixel by the count of photons
};
void describe(FieldVisitor& visitor, Exposure& exposure);

struct Rgb8 {
  std::uint8_t red{0}, green{0}, blue{0};
};
/// @param random of the pixel, or null without noise.
Rgb8 develop(const Exposure& exposure, const Vec3& radiance, const RayRandom* random);

/// Returns the value of a signal in sRGB (IEC 61966-2-1), rounded; 255 from 1 on.
std::uint8_t encode(double signal);

}  // namespace vegetation_sim::scan
