// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// How far ahead a stamp may be for which something waits [s].
constexpr double FARTHEST_AHEAD = 60.0;

/// Whether a stamp is farther ahead of `now` than FARTHEST_AHEAD.
bool isTooFarAhead(Nanoseconds stamp, Nanoseconds now);

/// @throws InvalidInput that names the stamp and the limit if the stamp isTooFarAhead().
void requireNear(Nanoseconds stamp, Nanoseconds now);

}  // namespace vegetation_sim
