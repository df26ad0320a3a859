// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/canopy/plants/plant.h"

namespace vegetation_sim::canopy {

/// Stage of growth from which a stalk has a tassel.
constexpr double TASSEL_STAGE = 0.8;
/// Number of rigid faces of a trellis: four of each post.
constexpr std::size_t TRELLIS_FACES = 8;

/// Grows a stalk with leaves on two sides that rise and arch over. The lower part of the stalk is
/// rigid; the upper part and the tassel are strips, which move with the leaves.
GrownPlant growStalk(const PlantKind& kind, const Plant& plant);
/// Returns the number of strips of a stalk.
std::size_t stalkLeafCount(const PlantKind& kind);

/// Builds two posts, `radius` apart along the yaw, and wires between them. The second post stands
/// higher by `slope` times their distance.
GrownPlant buildTrellis(const PlantKind& kind, const Plant& plant);

}  // namespace vegetation_sim::canopy
