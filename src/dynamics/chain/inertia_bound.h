// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/dynamics/chain/chain.h"

namespace vegetation_sim::physics {

/// Sets every link's `guaranteed_inertia`: the sum of guaranteed_inertia |rate|^2 over all joints
/// stays below twice the kinetic energy, for any rates. It is proved at the rest pose, with a
/// margin for bends (docs/physics.md). The stiffer a joint is relative to its inertia, the more it
/// gets. O(N).
void shareInertia(std::vector<Link>& links);

}  // namespace vegetation_sim::physics
