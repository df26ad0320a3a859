// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "trees/engine.h"
#include "vegetation_sim/dynamics/modes/modal_motion.h"

namespace vegetation_sim::bench {

/// Returns the tree as links of the core.
std::vector<physics::Link> coreLinks(const TestTree& tree);
/// Returns the joint torques of a load at factor 1, at rest.
std::vector<double> torquesOf(const physics::LinearChain& chain, const TestLoad& load);

/// A tree in modes (N13): `modes` of them, and `vectors` of the load. From 2 on the last of these
/// is quick, of half a frame of 60 Hz; for a pull from 5 on one more, of a quarter.
class ModalEngine : public Engine {
 public:
  ModalEngine(const TestTree& tree, const TestLoad& load, int modes, int vectors);
  void rest() override;
  void step(int interval, double time, double h) override;
  std::vector<Vec3> tips() const override;

  const physics::Modes& modes() const { return modes_; }
  /// Returns the largest turn since rest() [rad].
  double largestTurn() const { return largest_turn_; }

 private:
  const TestTree& tree_;
  const TestLoad& load_;
  physics::Modes modes_;
  physics::RotationProbe probe_;
  physics::ModalStepper stepper_;
  physics::ModalState state_;
  std::vector<double> push_, before_, after_;  // modal load at factor 1; before and after a step
  double largest_turn_{0.0};
};

/// A model without memory: every joint is where the present load would hold it, as on the
/// procedural tier.
class StaticEngine : public Engine {
 public:
  StaticEngine(const TestTree& tree, const TestLoad& load);
  void rest() override { factor_ = 0.0; }
  void step(int interval, double time, double h) override {
    factor_ = load_.factor(interval, time + h);
  }
  std::vector<Vec3> tips() const override;

 private:
  const TestTree& tree_;
  const TestLoad& load_;
  std::vector<double> bends_;  // at factor 1
  double factor_{0.0};
};

}  // namespace vegetation_sim::bench
