// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/forest/layout.h"

namespace vegetation_sim::forest {

/// How far the procedural rung, which answers the wind at once, is off where wind comes and goes:
/// the largest distance of any part of a crown from where its modes have it, in a breeze, per speed
/// that comes and goes there (wind::Instant::gustBound) [m per m/s]. Measured on sample trees;
/// 0 where joints do not bend.
double measureLag(const Species& species, const MotionLaw& law, double scale);

/// Share of it that modes are off themselves, against the full chain (docs/modal.md).
constexpr double MODAL_SHARE = 0.3;

}  // namespace vegetation_sim::forest
