// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "table.h"
#include "trees/test_trees.h"
#include "vegetation_sim/dynamics/modes/modes.h"

namespace vegetation_sim::bench {

/// Options of a measurement.
struct ModalOptions {
  std::vector<int> branches{100, 1000};
  std::string cache;        ///< folder of references; empty for none
  Table* table{nullptr};    ///< with MODAL_COLUMNS
  double procedural{12.0};  ///< cost of the procedural tier, as below [ns]
  int rounds{9};
  double duration{6.0};  ///< of breezes [s]
};

/// Columns of the table. The cost is that of a branch and frame of 60 Hz in addition to forward
/// kinematics, without finding the modes. Modes and vectors are -1 for models without them.
constexpr const char* MODAL_COLUMNS =
    "load,branches,model,modes,vectors,error,first_mm,cost_ns,find_ms,kb";

/// Returns the nanoseconds per branch and frame of a call that handles `branches` of them.
double costOf(const std::function<void()>& once, std::size_t branches);
/// Returns the cost of stepping modes and of computing the bends, without loads.
double modalCost(const physics::Modes& modes);
/// Returns the cost of the procedural tier in a breeze.
double proceduralCost();

/// Measures the error against full dynamics by number of modes, beside the procedural tier and
/// paper 1's dynamics, and the first frame of a sudden load.
void measureErrors(const TestTree& tree, const TestLoad& load, const ModalOptions& options);
/// Measures the error in ever stronger gusts: the rotation at which modes cease to hold.
void measureLimit(const TestTree& tree, const ModalOptions& options);
/// Measures the error in ever stronger breezes, with levers at rest and with levers that turn.
void measureBending();
/// Measures the time to find modes.
void measureFinding(const TestTree& tree, int rounds);
/// Measures the ticks of a forest while its trees get modes.
void measureTicks();
/// Measures the time to pose branches from modes.
void measurePosing(int rounds);

}  // namespace vegetation_sim::bench
