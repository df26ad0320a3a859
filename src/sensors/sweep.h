// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/threads/thread_pool.h"
#include "sensors/lidar.h"
#include "sensors/model/receiver.h"
#include "sensors/model/sensor_path.h"
#include "sensors/sensor_scene.h"

namespace vegetation_sim::scan {

/// Returns the number of returns of each ray in the list that sweep() returns.
int returnsPerRay(const SensorModel& model);

/// Casts all rays. [rings x columns x returnsPerRay] The scene has one instant, the sensor may
/// move. The result does not depend on the number of threads.
std::vector<Return> sweep(const Scene& scene, const Lidar& lidar, const SensorPath& path,
                          const NoiseKeys& noise, ThreadPool& threads);

/// Counts points by label, and rays without a point under NONE.
/// @param per_ray returns of each ray.
std::array<std::uint32_t, LABELS> countLabels(const std::vector<Return>& returns, int per_ray = 1);

}  // namespace vegetation_sim::scan
