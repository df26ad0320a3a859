// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/GrassCut.h>

#include "vegetation_sim/core/math/vectors.h"
#include "vegetation_sim/grass/tread/cut_map.h"

namespace vegetation_sim {

/// Returns the area of a request in the world frame. @param to_world pose of the frame of the
/// request. @throws InvalidInput with all values that are out of range.
grass::CutArea areaOf(const GrassCut& cut, const Pose& to_world);

}  // namespace vegetation_sim
