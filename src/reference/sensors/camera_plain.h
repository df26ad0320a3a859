// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sensors/sensor_scene.h"

namespace vegetation_sim::scan {

/// Returns what a camera's ray meets, as cast() with GrassGrain::BLADES does: tests every branch,
/// leaf of a plant and limb, and goes along the ray in steps of PLAIN_STEP through ground and
/// grass.
Hit castCameraPlain(const Scene& scene, const Ray& ray, double reach);

constexpr double PLAIN_STEP = 5e-4;  ///< [m]

}  // namespace vegetation_sim::scan
