// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "dynamics/integration/stability.h"

namespace vegetation_sim::physics {

/// Joints that turn farther than this in a step make the midpoint fall back to theta = 1 [rad].
constexpr double GUARD_TURN = 0.2;

/// Joints that turn farther than this in a step make implicit methods leave out velocity products,
/// which are explicit and would feed energy in [rad].
constexpr double WILD_TURN = 0.5;
/// Where implicit methods stop a joint, whatever drives it: a bend [rad], a turn per step [rad].
constexpr double LARGEST_BEND = 3.0, LARGEST_TURN = 1.0;

/// Steps chains; keeps scratch only, so one stepper serves many chains.
class ChainStepper {
 public:
  /// Of the chains that follow; the full chain until told otherwise.
  void setDynamics(Dynamics dynamics) { dynamics_ = dynamics; }
  void setProducts(Products products) { products_ = products; }

  /// One step of `h` seconds from `time`. `theta` belongs to the chain's state: 1/2 is the
  /// midpoint, 1 backward Euler, between is on the way back; others than MIDPOINT leave it alone.
  /// An explicit method runs in as many equal parts as its limit asks for (guardLimit), and not at
  /// all beyond MOST_SUB_STEPS.
  /// @return the parts; 0: refused, nothing has changed, take an implicit method.
  int step(Integrator integrator, const std::vector<Link>& links, const Surroundings& outside,
           double time, double h, ChainState& state, double& theta);
  /// The same in one part whatever its limit, to measure where methods break.
  void stepAsIs(Integrator integrator, const std::vector<Link>& links, const Surroundings& outside,
                double time, double h, ChainState& state, double& theta);

 private:
  using Angles = std::vector<Vec2>;

  /// Bases, kinematics and loads at a time and state.
  void look(const std::vector<Link>& links, const Surroundings& outside, double time,
            const ChainState& state);
  int partsOf(Integrator integrator, const std::vector<Link>& links, const Surroundings& outside,
              double time, double h, const ChainState& state);
  /// Accelerations at a time and state; leaves the kinematics in kinematics_.
  void evaluate(const std::vector<Link>& links, const Surroundings& outside, double time,
                const ChainState& state, const Implicitness& implicitness, Angles& out);
  void implicitStep(const std::vector<Link>& links, const Surroundings& outside, double time,
                    double h, double theta, ChainState& state);
  void explicitStep(bool as_printed, const std::vector<Link>& links, const Surroundings& outside,
                    double time, double h, ChainState& state);
  void rungeKuttaStep(const std::vector<Link>& links, const Surroundings& outside, double time,
                      double h, ChainState& state);

  Dynamics dynamics_{Dynamics::ARTICULATED};
  Products products_{Products::MEAN};
  ArticulatedBody body_;
  PaperBody paper_, printed_{PaperForm{true, true, true}};
  std::vector<BaseMotion> bases_;
  Kinematics kinematics_;
  Loads loads_;
  ChainState between_;
  Angles acceleration_;
  struct Slope {
    Angles rate, acceleration;
  };
  std::array<Slope, 4> slopes_;
};

/// 0 where the motion is too wild for velocity products, else 1.
double productsOf(const ChainState& state, double h);

/// Stops bends at LARGEST_BEND and turns at LARGEST_TURN a step.
void stopJoints(double h, ChainState& state);

/// Theta of the guarded midpoint for the coming step (numerics: it never falls at once).
double guardedTheta(const ChainState& state, double h, double theta);

}  // namespace vegetation_sim::physics
