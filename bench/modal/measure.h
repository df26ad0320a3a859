// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "table.h"
#include "trees/test_trees.h"
#include "vegetation_sim/dynamics/modal/modes.h"

namespace vegetation_sim::bench {

/// What to measure.
struct ModalOptions {
  std::vector<int> branches{100, 1000};
  std::string cache;        ///< folder of references; empty: none
  Table* table{nullptr};    ///< of MODAL_COLUMNS
  double procedural{12.0};  ///< cost of the procedural tier, as below [ns]
  int rounds{9};
  double duration{6.0};  ///< of breezes [s]
};

/// Columns of the table: cost is that of a branch and frame of 60 Hz beside forward kinematics,
/// finding the modes apart; modes and vectors are -1 for models without.
constexpr const char* MODAL_COLUMNS =
    "load,branches,model,modes,vectors,error,first_mm,cost_ns,find_ms,kb";

/// Nanoseconds a branch and frame of what a call does for `branches` of them.
double costOf(const std::function<void()>& once, std::size_t branches);
/// Of stepping modes and of what they bend, loads apart.
double modalCost(const physics::Modes& modes);
/// Of the procedural tier, in a breeze.
double proceduralCost();

/// Error against full dynamics by number of modes, beside the procedural tier and paper 1's
/// dynamics; what the first frame of a load that steps does.
void measureErrors(const TestTree& tree, const TestLoad& load, const ModalOptions& options);
/// Error in ever stronger gusts: the rotation at which modes cease to hold.
void measureLimit(const TestTree& tree, const ModalOptions& options);
/// Error in ever stronger breezes, with levers at rest and as they turn.
void measureBending();
/// Time to find modes.
void measureFinding(const TestTree& tree, int rounds);
/// Time to pose branches from modes.
void measurePosing(int rounds);

}  // namespace vegetation_sim::bench
