// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vegetation_sim::crowd::bench {

/// Proofs of `count` random queries; cost beside other libraries.
void benchQueries(double count, int rounds);
/// Cost of a step against the size of the crowd.
void benchScale(int rounds);
/// How walkers fare: each experiment under the goal behaviour and under the paper's law.
void benchBehaviour(int seeds);

}  // namespace vegetation_sim::crowd::bench
