// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "trees/reference.h"

namespace vegetation_sim::bench {

/// One way to step a tree under a load, ours or a peer's. Keeps references to both. Another load
/// may replace the old one while the engine rests.
class Engine {
 public:
  virtual ~Engine() = default;
  /// Returns to rest, without motion.
  virtual void rest() = 0;
  virtual void step(int interval, double time, double h) = 0;
  /// Returns the world positions of the tree's tips, in the order of TestTree::tips() [m].
  virtual std::vector<Vec3> tips() const = 0;
};

/// How to make an engine, and its properties.
struct Maker {
  std::string name;
  bool peer{false};
  Bend bend{Bend::SWING};
  int most_branches{1 << 20};  ///< larger trees take too long to build
  bool fast{false};            ///< one of ours, to be compared with the best peer
  std::unique_ptr<Engine> (*make)(const TestTree&, const TestLoad&, const std::string& cache){};
};

/// Returns our engines: every integrator in plain double, and the midpoint on wide vectors.
std::vector<Maker> ownEngines();
/// Returns extended position-based dynamics, which has no engine of its own in Debian.
std::vector<Maker> positionEngines();
/// Return the engines of others, as far as this build includes them.
std::vector<Maker> bulletEngines();
std::vector<Maker> dartEngines();
std::vector<Maker> mujocoEngines();
std::vector<Maker> simbodyEngines();

/// Returns the tips of a tree whose joints are bent by `q` [links][2].
std::vector<Vec3> tipsOf(const TestTree& tree, Bend bend, const std::vector<double>& q);

/// Moves an engine from rest with `steps` steps per interval. Ends early, with fewer instants, if
/// it is unstable (tips twice as far off as the reference ever was from rest) or `cap` seconds have
/// passed.
struct Drive {
  Motion motion;
  double seconds{0.0};  ///< processor time
  bool broken{false};
};
Drive drive(Engine& engine, const Reference& reference, int steps, double cap);

/// Returns the processor time of this thread [s].
double processorTime();

}  // namespace vegetation_sim::bench
