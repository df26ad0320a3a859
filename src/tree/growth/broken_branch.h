// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/tree/growth/skeleton.h"

namespace vegetation_sim {
class Archive;
}

namespace vegetation_sim::forest {

/// Maximum number of branches of a forest that can come off.
constexpr std::size_t MOST_BROKEN = 4096;
/// Largest components of velocity [m/s] and angular velocity [rad/s] of a branch that comes off.
constexpr double FASTEST_PIECE = 200.0, FASTEST_PIECE_SPIN = 1000.0;

/// Scales velocity and angular velocity down to what check() allows.
void limitMotion(BrokenBranch& broken);

std::size_t countBroken(const BrokenTrees& trees);
void addTo(Hash& hash, const BrokenTrees& trees);
void addTo(Hash& hash, const BrokenBranch& piece);
/// Writes or reads all. @param trees number of trees of the layout.
void archiveBroken(Archive& a, std::size_t trees, BrokenTrees& broken);
/// Adds a fault for each number out of range. @param name what the fault begins with.
void check(const BrokenBranch& broken, const std::string& name, Faults& faults);

}  // namespace vegetation_sim::forest
