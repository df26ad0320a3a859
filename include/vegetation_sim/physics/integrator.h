// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/physics/articulated.h"

namespace vegetation_sim::physics {

/// How a chain steps in time, from the most trusted to the one that only shows how it breaks.
enum class Integrator : int {
  MIDPOINT = 0,             ///< linearly implicit midpoint with a guard: second order (default)
  IMPLICIT_EULER = 1,       ///< linearly implicit: first order, over-damped
  SEMI_IMPLICIT_EULER = 2,  ///< stable for h^2 w^2 + 2 h c < 4 per joint (E12)
  EXPLICIT_EULER = 3,       ///< as paper 1 prints it (S1-33)
  RUNGE_KUTTA_4 = 4         ///< the reference: fourth order, explicit
};

/// Joints that turn farther than this in a step make the midpoint fall back to theta = 1 [rad].
constexpr double GUARD_TURN = 0.2;

/// Steps articulated chains; keeps scratch only, so one stepper serves many chains.
class ChainStepper {
 public:
  /// One step of `h` seconds from `time`. `theta` belongs to the chain's state: 1/2 is the
  /// midpoint, 1 backward Euler, between is on the way back; others than MIDPOINT leave it alone.
  void step(Integrator integrator, const std::vector<Link>& links, const Surroundings& outside,
            double time, double h, ChainState& state, double& theta);

 private:
  using Angles = std::vector<Vec2>;

  /// Accelerations at a time and state; leaves the kinematics in kinematics_.
  void evaluate(const std::vector<Link>& links, const Surroundings& outside, double time,
                const ChainState& state, const Implicitness& implicitness, Angles& out);
  void implicitStep(const std::vector<Link>& links, const Surroundings& outside, double time,
                    double h, double theta, ChainState& state);
  void explicitStep(bool as_printed, const std::vector<Link>& links, const Surroundings& outside,
                    double time, double h, ChainState& state);
  void rungeKuttaStep(const std::vector<Link>& links, const Surroundings& outside, double time,
                      double h, ChainState& state);

  ArticulatedBody body_;
  std::vector<BaseMotion> bases_;
  Kinematics kinematics_;
  Loads loads_;
  ChainState between_;
  Angles acceleration_;
  struct Slope {
    Angles rate, acceleration;
  };
  Slope slopes_[4];
};

/// Theta of the guarded midpoint for the coming step (numerics: it never falls at once).
double guardedTheta(const ChainState& state, double h, double theta);

}  // namespace vegetation_sim::physics
