// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sensors/sky_view.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::scan {

/// Returns the same as viewSky() by counting: of `rays` rays of random direction in each bin, those
/// that cast() lets out of the scene. Requires a place above the ground.
SkyTransmittance countOpenRays(const Scene& scene, const Vec3& place, double reach, int rays,
                               const Random& random);

}  // namespace vegetation_sim::scan
