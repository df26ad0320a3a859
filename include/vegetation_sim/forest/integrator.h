// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "vegetation_sim/forest/physical_tree.h"

namespace vegetation_sim::forest {

/// How a physical tree steps in time, from the most trusted to the one that only shows how it
/// breaks.
enum class Integrator : int {
  MIDPOINT = 0,             ///< linearly implicit midpoint with a guard: second order (default)
  IMPLICIT_EULER = 1,       ///< linearly implicit: first order, over-damped
  SEMI_IMPLICIT_EULER = 2,  ///< stable for h^2 w^2 + 2 h c < 4 per joint (E12)
  EXPLICIT_EULER = 3,       ///< as paper 1 prints it (S1-33)
  RUNGE_KUTTA_4 = 4         ///< the reference: fourth order, explicit
};

/// Joints that turn faster than this per step [rad] make the midpoint fall back to theta = 1.
constexpr double GUARD_TURN = 0.2;

/// Loads on the branches at a time [s], for given kinematics: [branches] wrenches.
using LoadFunction = std::function<void(const Kinematics&, double, std::vector<Wrench>&)>;

/// Steps a physical tree. Holds the theta of the guarded midpoint between steps, which is part of
/// the state.
class TreeStepper {
 public:
  explicit TreeStepper(Integrator integrator) : integrator_(integrator) {}

  /// One step of `h` seconds from `time`.
  void step(const std::vector<PhysicalBranch>& tree, const LoadFunction& loads, double time,
            double h, PhysicalState& state);
  /// 1/2: midpoint; 1: backward Euler; between: on the way back.
  double theta() const { return theta_; }

 private:
  void implicitStep(const std::vector<PhysicalBranch>& tree, const LoadFunction& loads, double time,
                    double h, double theta, PhysicalState& state) const;
  void guard(const PhysicalState& state, double h);

  Integrator integrator_;
  double theta_{0.5};
};

}  // namespace vegetation_sim::forest
