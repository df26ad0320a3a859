// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/threads/thread_pool.h"
#include "sensors/camera/camera.h"
#include "sensors/sensor_scene.h"

namespace vegetation_sim::scan {

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
