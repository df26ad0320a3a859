// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/threads/thread_pool.h"
#include "sensors/camera/daylight.h"
#include "sensors/camera/lens.h"
#include "sensors/camera/photo.h"
#include "sensors/sensor_scene.h"

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
  Photo photo;
};
/// Visits all but the lens.
void describe(FieldVisitor& visitor, Camera& camera);
/// Largest number of rays of a picture: pixels times samples.
constexpr std::int64_t MOST_IMAGE_RAYS = std::int64_t{1} << 24;
/// Adds the faults of lens, ranges and number of rays.
void check(const Camera& camera, const std::string& context, Faults& faults);

/// Which images are taken.
struct Wanted {
  bool colour{true}, depth{true}, label{true}, instance{true};
  bool any() const { return colour || depth || label || instance; }
};

/// Images of one instant, row by row from the top; those not wanted are empty.
struct Images {
  std::vector<Rgb8> colour;
  /// Distances along the optical axis [m] (REP 118); as REP 117 has it, infinite where nothing is
  /// within range_max, and -infinite below range_min.
  std::vector<float> depth;
  std::vector<std::uint16_t> label;    ///< Label
  std::vector<std::int32_t> instance;  ///< id of the tree, plant or person; -1 for others
};

/// Takes images; the result does not depend on the number of threads.
/// @param optical pose of the optical frame in the world. @param noise keys of the random numbers.
Images takeImages(const Scene& scene, const Camera& camera, const Pose& optical,
                  const NoiseKeys& noise, const Wanted& wanted, ThreadPool& threads);

}  // namespace vegetation_sim::scan
