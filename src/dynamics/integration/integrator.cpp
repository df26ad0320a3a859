// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/integration/integrator.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::physics {
namespace {

using Angles = std::vector<Vec2>;

// out = a + factor * b; out may be a.
void addScaled(const Angles& a, double factor, const Angles& b, Angles& out) {
  out.resize(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i] + factor * b[i];
}

double fastestOf(const ChainState& state) {
  double out = 0.0;
  for (const Vec2& rate : state.rate)
    out = std::max({out, std::fabs(rate.x()), std::fabs(rate.y())});
  return out;
}

// Says whether all joints turn by at most `turn` in `h` seconds; not so if a rate is not a number.
bool staysBelow(double turn, double h, const ChainState& state) {
  return std::all_of(state.rate.begin(), state.rate.end(), [&](const Vec2& rate) {
    return std::fabs(rate.x()) * h <= turn && std::fabs(rate.y()) * h <= turn;
  });
}

}  // namespace

double guardedTheta(const ChainState& state, double h, double theta) {
  return fastestOf(state) * h > GUARD_TURN ? 1.0 : std::max(0.5, 0.9 * theta);
}

double productsOf(const ChainState& state, double h) {
  return fastestOf(state) * h > WILD_TURN ? 0.0 : 1.0;
}

void stopJoints(double h, ChainState& state) {
  const double fastest = LARGEST_TURN / h;
  for (std::size_t i = 0; i < state.q.size(); ++i) {
    Vec2 &q = state.q[i], &rate = state.rate[i];
    const double bend2 = q.x() * q.x() + q.y() * q.y();
    if (bend2 > LARGEST_BEND * LARGEST_BEND) {
      const double outwards = (q.x() * rate.x() + q.y() * rate.y()) / bend2;
      if (outwards > 0.0) rate -= outwards * q;
      q *= LARGEST_BEND / std::sqrt(bend2);
    }
    const double speed2 = rate.x() * rate.x() + rate.y() * rate.y();
    if (speed2 > fastest * fastest) rate *= fastest / std::sqrt(speed2);
  }
}

void ChainStepper::updateKinematics(const std::vector<Link>& links, const Surroundings& outside,
                                    double time, const ChainState& state) {
  if (outside.bases) outside.bases(time, bases_);
  if (!outside.bases) bases_.clear();
  body_.updateKinematics(links, bases_, state, kinematics_);
  loads_.clear(links.size());
  if (outside.loads) outside.loads(kinematics_, time, loads_);
}

void ChainStepper::evaluate(const std::vector<Link>& links, const Surroundings& outside,
                            double time, const ChainState& state, const Implicitness& implicitness,
                            Angles& out) {
  updateKinematics(links, outside, time, state);
  if (dynamics_ == Dynamics::ARTICULATED)
    return body_.solve(links, bases_, state, kinematics_, loads_, implicitness, out);
  PaperBody& paper = dynamics_ == Dynamics::PAPER ? paper_ : printed_;
  paper.accelerations(links, bases_, state, kinematics_, loads_, implicitness, out);
}

// Springs and loads are evaluated where the joints will be after theta h at the present rates; what
// acceleration adds to that is implicit.
void ChainStepper::implicitStep(const std::vector<Link>& links, const Surroundings& outside,
                                double time, double h, double theta, ChainState& state) {
  addScaled(state.q, theta * h, state.rate, between_.q);
  between_.rate = state.rate;
  const double products = productsOf(state, h);
  evaluate(links, outside, time + theta * h, between_, implicitFor(theta, h, products),
           acceleration_);
  const bool mean = products_ == Products::MEAN && dynamics_ == Dynamics::ARTICULATED;
  if (mean && theta == 0.5 && products == 1.0)
    body_.averageProducts(links, bases_, between_, kinematics_, h, acceleration_);
  for (std::size_t i = 0; i < links.size(); ++i) {
    state.q[i] += h * (state.rate[i] + (theta * h) * acceleration_[i]);
    state.rate[i] += h * acceleration_[i];
  }
  stopJoints(h, state);
}

void ChainStepper::explicitStep(bool as_printed, const std::vector<Link>& links,
                                const Surroundings& outside, double time, double h,
                                ChainState& state) {
  evaluate(links, outside, time, state, {}, acceleration_);
  if (as_printed) addScaled(state.q, h, state.rate, state.q);
  addScaled(state.rate, h, acceleration_, state.rate);
  if (!as_printed) addScaled(state.q, h, state.rate, state.q);
}

void ChainStepper::rungeKuttaStep(const std::vector<Link>& links, const Surroundings& outside,
                                  double time, double h, ChainState& state) {
  constexpr double AHEAD[] = {0.0, 0.5, 0.5, 1.0};
  for (std::size_t stage = 0; stage < slopes_.size(); ++stage) {
    Slope& slope = slopes_[stage];
    between_ = state;
    if (stage > 0) {
      const double ahead = AHEAD[stage] * h;
      addScaled(state.q, ahead, slopes_[stage - 1].rate, between_.q);
      addScaled(state.rate, ahead, slopes_[stage - 1].acceleration, between_.rate);
    }
    slope.rate = between_.rate;
    evaluate(links, outside, time + AHEAD[stage] * h, between_, {}, slope.acceleration);
  }
  for (std::size_t i = 0; i < links.size(); ++i) {
    const auto mean = [&](Angles Slope::*what) {
      return Vec2(h / 6.0 *
                  ((slopes_[0].*what)[i] + 2.0 * (slopes_[1].*what)[i] +
                   2.0 * (slopes_[2].*what)[i] + (slopes_[3].*what)[i]));
    };
    state.q[i] += mean(&Slope::rate);
    state.rate[i] += mean(&Slope::acceleration);
  }
}

int ChainStepper::partsOf(Integrator integrator, const std::vector<Link>& links,
                          const Surroundings& outside, double time, double h,
                          const ChainState& state) {
  updateKinematics(links, outside, time, state);
  ChainRates rates = guardRates(dynamics_, links, kinematics_, loads_.anchors);
  // The limits are those of small motion.
  const double turning = GUARD_TURN / std::max(fastestOf(state), 1e-9);
  const int parts = subSteps(std::min(guardLimit(integrator, rates), turning), h);
  if (parts == 1 || dynamics_ != Dynamics::ARTICULATED) return parts;
  rates = tighter(rates, estimatedRates(links, bases_, state, loads_.anchors));
  return subSteps(std::min(guardLimit(integrator, rates), turning), h);
}

int ChainStepper::step(Integrator integrator, const std::vector<Link>& links,
                       const Surroundings& outside, double time, double h, ChainState& state,
                       double& theta) {
  if (isImplicit(integrator)) {
    stepAsIs(integrator, links, outside, time, h, state, theta);
    return 1;
  }
  const int parts = partsOf(integrator, links, outside, time, h, state);
  before_ = state;
  for (int i = 0; i < parts; ++i) {
    stepAsIs(integrator, links, outside, time + i * (h / parts), h / parts, state, theta);
    if (staysBelow(WILD_TURN, h / parts, state)) continue;
    state = before_;
    return 0;
  }
  return parts;
}

void ChainStepper::stepAsIs(Integrator integrator, const std::vector<Link>& links,
                            const Surroundings& outside, double time, double h, ChainState& state,
                            double& theta) {
  switch (integrator) {
    case Integrator::MIDPOINT:
      theta = guardedTheta(state, h, theta);
      return implicitStep(links, outside, time, h, theta, state);
    case Integrator::IMPLICIT_EULER:
      return implicitStep(links, outside, time, h, 1.0, state);
    case Integrator::SEMI_IMPLICIT_EULER:
    case Integrator::EXPLICIT_EULER:
      return explicitStep(integrator == Integrator::EXPLICIT_EULER, links, outside, time, h, state);
    case Integrator::RUNGE_KUTTA_4:
      return rungeKuttaStep(links, outside, time, h, state);
  }
}

}  // namespace vegetation_sim::physics
