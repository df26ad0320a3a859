// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vegetation_sim::crowd::bench {

/// Measures proofs of `count` random queries and their cost beside other libraries.
void benchQueries(double count, int rounds);
/// Measures the cost of a step against the size of the crowd.
void benchScale(int rounds);
/// Measures ticks and memory while wanderers find their ways between rooms.
void benchGoals(double seconds);
/// Runs each experiment with walkers under the goal behaviour and under the paper's law.
void benchBehaviour(int seeds);

}  // namespace vegetation_sim::crowd::bench
