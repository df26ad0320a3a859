// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/tree/motion/batch_poser.h"

namespace vegetation_sim::forest {

/// Poses in single precision as BatchPoser gives them. `out` keeps its memory from call to call.
void narrow(const std::vector<Pose>& poses, BatchPoses& out);

}  // namespace vegetation_sim::forest
