// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "dynamics/integration/stability.h"

namespace vegetation_sim::physics {

/// A joint that turns farther than this in a step makes the midpoint fall back to theta = 1 [rad].
constexpr double GUARD_TURN = 0.2;

/// A joint that turns farther than this in a step makes implicit methods omit velocity products,
/// which are explicit and would add energy, and explicit methods reject the step [rad].
constexpr double WILD_TURN = 0.5;
/// Largest bend [rad] and largest turn per step [rad] that implicit methods allow a joint, whatever
/// drives it.
constexpr double LARGEST_BEND = 3.0, LARGEST_TURN = 1.0;

/// Steps chains. Keeps scratch memory only, so one stepper serves many chains.
class ChainStepper {
 public:
  /// Selects the dynamics of later steps; the default is the full chain.
  void setDynamics(Dynamics dynamics) { dynamics_ = dynamics; }
  void setProducts(Products products) { products_ = products; }

  /// Takes one step of `h` seconds from `time`. `theta` belongs to the chain's state: 1/2 is the
  /// midpoint and 1 backward Euler, with values in between on the way back; only MIDPOINT changes
  /// it. An explicit method runs in as many equal parts as its limit requires (guardLimit), and as
  /// its joints need to turn by at most GUARD_TURN in each, but not at all beyond MOST_SUB_STEPS,
  /// nor where a load makes a joint so fast that it would turn by more than WILD_TURN in a part.
  /// @return the number of parts, or 0 if the step was rejected and nothing has changed: use an
  /// implicit method.
  int step(Integrator integrator, const std::vector<Link>& links, const Surroundings& outside,
           double time, double h, ChainState& state, double& theta);
  /// Does the same in one part whatever its limit, to measure where methods break.
  void stepAsIs(Integrator integrator, const std::vector<Link>& links, const Surroundings& outside,
                double time, double h, ChainState& state, double& theta);

 private:
  using Angles = std::vector<Vec2>;

  /// Computes bases, kinematics and loads at a time and state.
  void updateKinematics(const std::vector<Link>& links, const Surroundings& outside, double time,
                        const ChainState& state);
  int partsOf(Integrator integrator, const std::vector<Link>& links, const Surroundings& outside,
              double time, double h, const ChainState& state);
  /// Computes the accelerations at a time and state; leaves the kinematics in kinematics_.
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
  ChainState between_, before_;
  Angles acceleration_;
  struct Slope {
    Angles rate, acceleration;
  };
  std::array<Slope, 4> slopes_;
};

/// Returns 0 where the motion is too fast for velocity products, else 1.
double productsOf(const ChainState& state, double h);

/// Limits bends to LARGEST_BEND and turns to LARGEST_TURN per step.
void stopJoints(double h, ChainState& state);

/// Returns theta of the guarded midpoint for the coming step. It never falls at once.
double guardedTheta(const ChainState& state, double h, double theta);

}  // namespace vegetation_sim::physics
