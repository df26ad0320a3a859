// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sensors/geometry/rod.h"

namespace vegetation_sim::scan {

/// Does the same as within(), from the intervals of the cylinder and of both balls for each ray.
Stretch withinPlainly(const Ray& ray, const Rod& rod, double radius);

}  // namespace vegetation_sim::scan
