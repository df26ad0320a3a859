// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vegetation_sim::grass {

/// ARC is a hinge at the root plus an arc of equal links, whose length is constant by construction.
/// PAPER is the Hermite curve of paper 2, section 3.3, which grows as it bends (E14).
enum class BladeModel : int { ARC = 0, PAPER = 1 };

constexpr int LINKS = 5;            ///< segments of a blade (S2-08)
constexpr int POINTS = LINKS + 1;   ///< points of a blade, root first
constexpr double BEND_KNEE = 0.8;   ///< A bend up to this is not reduced [rad].
constexpr double BEND_LIMIT = 1.5;  ///< largest bend or crush [rad], 4 degrees from flat

}  // namespace vegetation_sim::grass
