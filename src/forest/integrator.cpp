// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/integrator.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::forest {
namespace {

using Angles = std::vector<Eigen::Vector2d>;

Angles accelerationsAt(const std::vector<PhysicalBranch>& tree, const LoadFunction& loads,
                       double time, const PhysicalState& state, const Implicitness& implicitness) {
  std::vector<Wrench> wrenches(tree.size());
  if (loads) loads(kinematicsOf(tree, state), time, wrenches);
  return articulatedAccelerations(tree, state, wrenches, implicitness);
}

Angles sum(const Angles& a, double factor, const Angles& b) {
  Angles out(a);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += factor * b[i];
  return out;
}

// One stage of Runge and Kutta's method: rates of change at state + h * stage.
struct Stage {
  Angles rate, acceleration;
};

Stage stageAt(const std::vector<PhysicalBranch>& tree, const LoadFunction& loads, double time,
              const PhysicalState& from, double h, const Stage& slope) {
  const PhysicalState at{sum(from.q, h, slope.rate), sum(from.rate, h, slope.acceleration)};
  return {at.rate, accelerationsAt(tree, loads, time, at, {})};
}

void rungeKuttaStep(const std::vector<PhysicalBranch>& tree, const LoadFunction& loads, double time,
                    double h, PhysicalState& state) {
  const Stage none{Angles(tree.size(), Eigen::Vector2d::Zero()),
                   Angles(tree.size(), Eigen::Vector2d::Zero())};
  const Stage a = stageAt(tree, loads, time, state, 0.0, none);
  const Stage b = stageAt(tree, loads, time + 0.5 * h, state, 0.5 * h, a);
  const Stage c = stageAt(tree, loads, time + 0.5 * h, state, 0.5 * h, b);
  const Stage d = stageAt(tree, loads, time + h, state, h, c);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    state.q[i] += h / 6.0 * (a.rate[i] + 2.0 * b.rate[i] + 2.0 * c.rate[i] + d.rate[i]);
    state.rate[i] +=
        h / 6.0 *
        (a.acceleration[i] + 2.0 * b.acceleration[i] + 2.0 * c.acceleration[i] + d.acceleration[i]);
  }
}

}  // namespace

// q' = q + h ((1 - theta) rate + theta rate'), rate' = rate + h a, with spring and damper taken at
// theta between the ends and the geometry at q + theta h rate.
void TreeStepper::implicitStep(const std::vector<PhysicalBranch>& tree, const LoadFunction& loads,
                               double time, double h, double theta, PhysicalState& state) const {
  const PhysicalState between{sum(state.q, theta * h, state.rate), state.rate};
  const Angles a = accelerationsAt(tree, loads, time + theta * h, between,
                                   {0.0, theta * theta * h * h, theta * h});
  for (std::size_t i = 0; i < tree.size(); ++i) {
    state.q[i] += h * (state.rate[i] + theta * h * a[i]);
    state.rate[i] += h * a[i];
  }
}

void TreeStepper::guard(const PhysicalState& state, double h) {
  double fastest = 0.0;
  for (const Eigen::Vector2d& rate : state.rate)
    fastest = std::max({fastest, std::fabs(rate.x()), std::fabs(rate.y())});
  theta_ = fastest * h > GUARD_TURN ? 1.0 : std::max(0.5, 0.9 * theta_);
}

void TreeStepper::step(const std::vector<PhysicalBranch>& tree, const LoadFunction& loads,
                       double time, double h, PhysicalState& state) {
  switch (integrator_) {
    case Integrator::MIDPOINT:
      guard(state, h);
      return implicitStep(tree, loads, time, h, theta_, state);
    case Integrator::IMPLICIT_EULER:
      return implicitStep(tree, loads, time, h, 1.0, state);
    case Integrator::RUNGE_KUTTA_4:
      return rungeKuttaStep(tree, loads, time, h, state);
    case Integrator::EXPLICIT_EULER:
    case Integrator::SEMI_IMPLICIT_EULER: {
      const Angles a = accelerationsAt(tree, loads, time, state, {});
      const bool as_printed = integrator_ == Integrator::EXPLICIT_EULER;
      if (as_printed) state.q = sum(state.q, h, state.rate);
      state.rate = sum(state.rate, h, a);
      if (!as_printed) state.q = sum(state.q, h, state.rate);
    }
  }
}

}  // namespace vegetation_sim::forest
