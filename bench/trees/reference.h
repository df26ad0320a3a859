// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "trees/test_trees.h"

namespace vegetation_sim::bench {

/// How two angles turn a link: as one rotation vector about its rest x and y (ours), or about x and
/// then about the turned y (two hinges, as the peers have it). Equal to first order.
enum class Bend : int { SWING = 0, HINGES = 1 };
const char* nameOf(Bend bend);

/// Tips at the instants: [INTERVALS][tips], world axes [m].
using Motion = std::vector<std::vector<Vec3>>;

/// The full articulated chain, written apart from the product to check it: Featherstone's
/// articulated-body recursion with 3 x 3 blocks about each joint, world axes, any step of RK4.
class ReferenceChain {
 public:
  ReferenceChain(const TestTree& tree, const TestLoad& load, Bend bend);
  ~ReferenceChain();

  /// Returns the motion from rest over `intervals` of `steps` steps each; ends early once it
  /// diverges.
  Motion run(int steps, int intervals = INTERVALS);
  /// Returns the tips for [links][q0 q1 rate0 rate1].
  std::vector<Vec3> tips(const std::vector<double>& state);

 private:
  struct Joint;
  using State = std::vector<double>;  // [links][q0 q1 rate0 rate1]

  void turnOut(const State& state);
  void load(double factor);
  void sweepIn(const State& state);
  void sweepOut(const State& state, State& derivative);
  void derive(int interval, double time, const State& state, State& derivative);

  void step(int interval, double time, double h, State& state);
  std::vector<Vec3> tipPositions() const;

  const TestTree& tree_;
  const TestLoad& load_;
  Bend bend_;
  std::vector<Joint> joints_;
  std::vector<int> tips_;
};

/// A reference and its convergence.
struct Reference {
  Motion motion, rest;    ///< rest: [1][tips]
  double converged{0.0};  ///< relative error by Richardson's rule
  int steps{0};           ///< per interval
  double seconds{0.0};    ///< of its finest run
};

/// Computes a reference over the first `intervals`: the step is shortened by 1.5 until `tolerance`
/// holds, or 1e-4 if the next run would cost more than `cap` seconds. Reads it from and writes it
/// to `folder`, unless that is empty, by the hash of tree, load, bend, tolerance and intervals.
Reference referenceOf(const TestTree& tree, const TestLoad& load, Bend bend, double tolerance,
                      double cap, const std::string& folder, int intervals = INTERVALS);

/// Returns the RMS over tips and the instants of `motion` of the distance between two motions, over
/// that of `reference` from rest; infinite without instants.
double relativeError(const Motion& motion, const Reference& reference);

}  // namespace vegetation_sim::bench
