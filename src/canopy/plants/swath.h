// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "canopy/plants/stubble.h"

namespace vegetation_sim::canopy {

/// Lays what was cut off a plant on the ground around its foot, and adds it to the leaves. Ribbons
/// lie stretched in about the direction in which the plant falls, which its seed chooses; single
/// leaves fall straight down. All lie level with the foot, at most SWATH_HEIGHT above it, and keep
/// their length and width.
void layDown(const PlantKind& kind, const Plant& plant, const std::vector<FallenLeaf>& fallen,
             std::vector<Leaf>& leaves);

/// Thickness of the layer of cut leaves [m].
constexpr double SWATH_HEIGHT = 0.04;

}  // namespace vegetation_sim::canopy
