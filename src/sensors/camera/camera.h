// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "sensors/camera/daylight.h"
#include "sensors/camera/exposure.h"
#include "sensors/camera/lens.h"

namespace vegetation_sim::scan {

/// SUN: objects within range_max hide the sun from each other.
enum class Shadows { NONE, SUN };

/// A camera.
struct Camera {
  Lens lens;
  double range_min{0.05};   ///< of the depth image [m]
  double range_max{100.0};  ///< objects beyond are not seen [m]
  int samples{1};  ///< rays of a pixel of the picture; the first is that of the other images
  Shadows shadows{Shadows::SUN};
  Weatherlight light;
  Exposure exposure;
};
/// Visits all but the lens.
void describe(FieldVisitor& visitor, Camera& camera);
/// Largest number of rays of a picture: pixels times samples.
constexpr std::int64_t MOST_IMAGE_RAYS = std::int64_t{1} << 24;
/// Adds the faults of lens, ranges and number of rays.
void check(const Camera& camera, const std::string& context, Faults& faults);

}  // namespace vegetation_sim::scan
