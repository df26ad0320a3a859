// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace vegetation_sim::fuzz {

/// What a case gives.
struct CaseOutcome {
  std::uint64_t hash{0};  ///< of all states, tick by tick
  int ticks{0}, requests{0}, rejected{0};
};

/// Runs one random world: layout, wind, requests, lost updates, and a clock that stands, jumps
/// ahead and jumps back. All of it follows from seed and number of the case. @throws Divergence
/// or whatever the product throws.
CaseOutcome runCase(std::uint64_t seed, std::uint64_t number, int threads);

}  // namespace vegetation_sim::fuzz
