// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/FindTrees.h>
#include <vegetation_sim/Pick.h>

#include "forest/pick.h"

namespace vegetation_sim {

/// Ray of a request, in the frame of the request. @throws InvalidInput for values out of range.
forest::Ray rayOf(const Pick::Request& request);

/// @throws InvalidInput for a limit, or a centre and radius that are used, out of range.
void check(const FindTrees::Request& request);

}  // namespace vegetation_sim
