// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "trees/reference.h"

namespace vegetation_sim::bench {

/// One way to step a tree under a load, ours or a peer's. Keeps references to both; another load
/// may take the old one's place while the engine rests.
class Engine {
 public:
  virtual ~Engine() = default;
  /// Back to rest, at rest.
  virtual void rest() = 0;
  virtual void step(int interval, double time, double h) = 0;
  /// World positions of the tree's tips, in the order of TestTree::tips() [m].
  virtual std::vector<Vec3> tips() const = 0;
};

/// How an engine is made and what is known of it.
struct Maker {
  std::string name;
  bool peer{false};
  Bend bend{Bend::SWING};
  int most_branches{1 << 20};  ///< larger trees take too long to build
  bool fast{false};            ///< ours, to be held against the best peer
  std::unique_ptr<Engine> (*make)(const TestTree&, const TestLoad&, const std::string& cache){};
};

/// Ours: every integrator in plain double, and the midpoint on wide vectors.
std::vector<Maker> ownEngines();
/// Engines of others, as far as this build has them.
std::vector<Maker> bulletEngines();
std::vector<Maker> dartEngines();
std::vector<Maker> mujocoEngines();

/// Tips of a tree whose joints are bent by `q` [links][2].
std::vector<Vec3> tipsOf(const TestTree& tree, Bend bend, const std::vector<double>& q);

/// Moves an engine from rest with `steps` steps an interval; ends early, with fewer instants, if it
/// breaks (tips twice as far off as the reference ever was from rest) or `cap` seconds have passed.
struct Drive {
  Motion motion;
  double seconds{0.0};  ///< of the processor
  bool broken{false};
};
Drive drive(Engine& engine, const Reference& reference, int steps, double cap);

/// Seconds of this thread on the processor.
double processorTime();

}  // namespace vegetation_sim::bench
