// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "trees/test_trees.h"

namespace vegetation_sim::bench {

/// What to measure.
struct ModalOptions {
  std::vector<int> branches{100, 1000};
  std::string cache;  ///< folder of references; empty: none
  int rounds{9};
  double duration{6.0};  ///< of breezes [s]
};

/// Error against full dynamics by number of modes, beside the procedural rung and paper 1's
/// dynamics; what the first frame of a load that steps does.
void measureErrors(const TestTree& tree, const TestLoad& load, const ModalOptions& options);
/// Error in ever stronger gusts: the rotation at which modes cease to hold.
void measureLimit(const TestTree& tree, const ModalOptions& options);
/// Time to find modes.
void measureFinding(const TestTree& tree, int rounds);
/// Time to pose branches from modes.
void measurePosing(int rounds);

}  // namespace vegetation_sim::bench
