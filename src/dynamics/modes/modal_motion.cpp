// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/dynamics/modes/modal_motion.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::physics {
namespace {

// exp of the matrix (0 1; -w2 -c) times h: a series for a part of h, then squared as often as
// needed. It holds for any damping, where closed forms need a case for each.
struct Matrix {
  double aa, ab, ba, bb;
};

Matrix product(const Matrix& p, const Matrix& q) {
  return {p.aa * q.aa + p.ab * q.ba, p.aa * q.ab + p.ab * q.bb, p.ba * q.aa + p.bb * q.ba,
          p.ba * q.ab + p.bb * q.bb};
}

Matrix exponential(double w2, double c, double h) {
  constexpr double PART = 0.125;  // of a radian
  constexpr int TERMS = 12;
  const double rate = std::sqrt(w2) + c;
  int bisection = 0;
  while (rate * h > PART && bisection < 1000) h *= 0.5, ++bisection;
  // The difference to the identity is kept, so that slow modes keep their digits.
  Matrix power{1.0, 0.0, 0.0, 1.0}, rest{0.0, 0.0, 0.0, 0.0};
  for (int n = 1; n <= TERMS; ++n) {
    power = product(power, {0.0, h / n, -w2 * h / n, -c * h / n});
    rest = {rest.aa + power.aa, rest.ab + power.ab, rest.ba + power.ba, rest.bb + power.bb};
  }
  for (; bisection > 0; --bisection) {  // (1 + r)^2 = 1 + 2 r + r^2
    const Matrix square = product(rest, rest);
    rest = {2.0 * rest.aa + square.aa, 2.0 * rest.ab + square.ab, 2.0 * rest.ba + square.ba,
            2.0 * rest.bb + square.bb};
  }
  return {1.0 + rest.aa, rest.ab, rest.ba, 1.0 + rest.bb};
}

}  // namespace

RotationProbe::RotationProbe(const LinearChain& chain, const Modes& modes) {
  std::vector<std::vector<SmallMotion>> motions(modes.size());
  for (std::size_t m = 0; m < modes.size(); ++m) {
    chain.motionOf(modes.shapeOf(m), motions[m]);
    std::size_t most = 0;
    for (std::size_t i = 1; i < motions[m].size(); ++i)
      if (dot(motions[m][i].turn, motions[m][i].turn) >
          dot(motions[m][most].turn, motions[m][most].turn))
        most = i;
    links.push_back(static_cast<int>(most));
  }
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
  for (const int link : links)
    for (const auto& motion : motions) turn.push_back(motion[static_cast<std::size_t>(link)].turn);
}

double RotationProbe::largestTurn(const std::vector<double>& amplitude) const {
  double most = 0.0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t m = 0; m < amplitude.size(); ++m)
      sum += amplitude[m] * turn[i * amplitude.size() + m];
    most = std::max(most, dot(sum, sum));
  }
  return std::sqrt(most);
}

ModalStepper::ModalStepper(const Modes& modes) : damping_(modes.damping) {
  for (const double w : modes.frequency) square_.push_back(w * w);
}

ModalState ModalStepper::atRest() const {
  return {std::vector<double>(size(), 0.0), std::vector<double>(size(), 0.0)};
}

void ModalStepper::prepare(double h) {
  if (h == step_) return;
  propagators_.resize(size());
  for (std::size_t i = 0; i < size(); ++i) {
    const Matrix m = exponential(square_[i], damping_[i], h);
    propagators_[i] = {m.aa, m.ab, m.ba, m.bb};
  }
  step_ = h;
}

// Under a load f + s t, the motion p(t) = (f + s t) / w^2 - c s / w^4 is a solution; the rest of
// the state oscillates freely.
void ModalStepper::step(const std::vector<double>& before, const std::vector<double>& after,
                        double h, ModalState& state) {
  prepare(h);
  for (std::size_t i = 0; i < size(); ++i) {
    const double slope = (after[i] - before[i]) / (h * square_[i]);
    const double offset = damping_[i] * slope / square_[i];
    const double a = state.amplitude[i] - (before[i] / square_[i] - offset);
    const double b = state.rate[i] - slope;
    const Propagator& p = propagators_[i];
    state.amplitude[i] = p.aa * a + p.ab * b + (after[i] / square_[i] - offset);
    state.rate[i] = p.ba * a + p.bb * b + slope;
  }
}

void ModalStepper::accelerations(const ModalState& state, const std::vector<double>& load,
                                 std::vector<double>& out) const {
  out.resize(size());
  for (std::size_t i = 0; i < size(); ++i)
    out[i] = load[i] - damping_[i] * state.rate[i] - square_[i] * state.amplitude[i];
}

}  // namespace vegetation_sim::physics
