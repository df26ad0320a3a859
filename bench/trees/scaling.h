// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "trees/engine.h"

namespace vegetation_sim::bench {

/// Returns how many times more trees an engine steps per second with a tree on each of `threads`
/// threads than with one: median of `rounds`, of real time. @param steps per interval.
double scalingOf(const Maker& maker, const TestTree& tree, const TestLoad& load,
                 const std::string& cache, double steps, int threads, int rounds);

}  // namespace vegetation_sim::bench
