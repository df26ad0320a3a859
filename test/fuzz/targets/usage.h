// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/threads/thread_pool.h"
#include "fuzz/fuzz_target.h"
#include "sensors/sweep.h"
#include "vegetation_sim/core/math/time.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::fuzz {

/// Stamp around which all seeds lie.
constexpr Nanoseconds START = 1700000000 * NANOSECONDS_PER_SECOND;
/// Radius around the sensor within which a scene is used [m].
constexpr double SENSOR_RANGE = 6.0;
inline const Vec3 SENSOR_PLACE(1.0, 1.0, 1.5);

/// Casts the rays of a small lidar. @throws BrokenPromise for a range that is NaN or negative.
void sweepOnce(const scan::Scene& scene);
/// @throws BrokenPromise for a value that is not finite.
void requireFinite(const Vec3& value, const char* what);
void requireFinite(const std::vector<Pose>& poses, const char* what);
void requireFinite(const std::vector<float>& values, const char* what);

}  // namespace vegetation_sim::fuzz
