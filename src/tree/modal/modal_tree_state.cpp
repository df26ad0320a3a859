// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/modal/modal_tree_state.h"

#include <algorithm>

#include "dynamics/modes/coupled_motion.h"
#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim::forest {
namespace {

// Rounds a step to whole microseconds, so that a tick period that is no whole number of nanoseconds
// has one step, whose propagators are computed once.
double wholeMicroseconds(Nanoseconds step) {
  const Nanoseconds microseconds = (step + 500) / 1000;
  return 1e-6 * static_cast<double>(microseconds);
}

}  // namespace

ModalTreeState::ModalTreeState(std::shared_ptr<const ModalTree> modes)
    : modes_(std::move(modes)),
      batch_(std::make_shared<const physics::BatchModes>(modes_->modes())),
      stepper_(modes_->modes()),
      state_(stepper_.atRest()),
      before_(state_) {}

void ModalTreeState::loadOf(const wind::Instant& wind, ModalLoad& out) {
  modes_->loadOf(wind, air_, out.force);
  out.air = modes_->airOn(wind);
  if (modes_->hasQuadraticDrag()) out.velocity = modes_->velocitiesOf(air_);
}

void ModalTreeState::addLeverForces(const ModalLoad& load, const physics::ModalState& state,
                                    std::vector<double>& out) {
  out = load.force;
  modes_->bendLevers(modes_->leverAir(load.air, state.rate), state.amplitude, air_, out);
}

// Accelerations depend on the state alone, so that replicas that receive it extrapolate with the
// same bits.
void ModalTreeState::finishStep(const ModalLoad& load, Nanoseconds stamp) {
  addLeverForces(load, state_, after_load_);
  if (modes_->hasQuadraticDrag()) {
    modes_->dampingIn(load.velocity, state_.rate, damping_);
    coupledAccelerations(stepper_.squares(), damping_, state_, after_load_, acceleration_);
  } else {
    stepper_.accelerations(state_, after_load_, acceleration_);
  }
  stamp_ = stamp;
}

bool ModalTreeState::fine() const {
  return modes_->size() > ModalDepth{}.most() || modes_->size() == modes_->modes().length;
}

// Starts at the static response to each load; its rate is the central difference.
void ModalTreeState::begin(const std::array<ModalLoad, 3>& loads, double step, Nanoseconds stamp) {
  for (std::size_t m = 0; m < state_.amplitude.size(); ++m) {
    const double w = modes_->modes().frequency[m], stiffness = w * w;
    state_.amplitude[m] = loads[1].force[m] / stiffness;
    state_.rate[m] = (loads[2].force[m] - loads[0].force[m]) / (2.0 * step * stiffness);
  }
  before_ = state_;
  before_stamp_ = stamp;
  finishStep(loads[1], stamp);
}

void ModalTreeState::restore(const physics::ModalState& state, const ModalLoad& load,
                             Nanoseconds stamp) {
  if (state.amplitude.size() != modes_->size() || state.rate.size() != modes_->size())
    throw InvalidInput("modes: " + std::to_string(state.amplitude.size()) + " amplitudes and " +
                       std::to_string(state.rate.size()) + " rates, the tree has " +
                       std::to_string(modes_->size()));
  state_ = before_ = state;
  before_stamp_ = stamp;
  finishStep(load, stamp);
}

// Lever arms rotate by the bends at the end of a trial step, and quadratic drag damps by the
// velocity relative to the wood in the middle.
void ModalTreeState::stepOnce(const ModalLoad& from, const ModalLoad& to, double h) {
  const bool coupled = modes_->hasQuadraticDrag();
  const auto advance = [&](physics::ModalState& state) {
    if (coupled)
      stepCoupled(stepper_.squares(), damping_, before_load_, after_load_, h, state);
    else
      stepper_.step(before_load_, after_load_, h, state);
  };
  addLeverForces(from, state_, before_load_);
  trial_ = state_;
  after_load_ = before_load_;
  for (std::size_t m = 0; m < after_load_.size(); ++m)
    after_load_[m] += to.force[m] - from.force[m];
  if (coupled) modes_->dampingIn(from.velocity, state_.rate, damping_);
  advance(trial_);
  addLeverForces(to, trial_, after_load_);
  if (coupled) {
    std::vector<Vec3> velocity = from.velocity;
    std::vector<double> rate = state_.rate;
    for (std::size_t i = 0; i < velocity.size(); ++i)
      velocity[i] = 0.5 * (velocity[i] + to.velocity[i]);
    for (std::size_t m = 0; m < rate.size(); ++m) rate[m] = 0.5 * (rate[m] + trial_.rate[m]);
    modes_->dampingIn(velocity, rate, damping_);
  }
  advance(state_);
}

void ModalTreeState::step(const std::vector<ModalLoad>& loads, Nanoseconds stamp) {
  before_ = state_;
  before_stamp_ = stamp_;
  const auto steps = static_cast<Nanoseconds>(loads.size()) - 1;
  const double h = wholeMicroseconds((stamp - stamp_) / steps);
  for (std::size_t i = 0; i + 1 < loads.size(); ++i) stepOnce(loads[i], loads[i + 1], h);
  finishStep(loads.back(), stamp);
}

std::vector<double> ModalTreeState::amplitudeAt(Nanoseconds stamp) const {
  const double ahead =
      std::clamp(secondsBetween(stamp_, stamp), -LONGEST_LOOK_AHEAD, LONGEST_LOOK_AHEAD);
  std::vector<double> out = state_.amplitude;
  for (std::size_t m = 0; m < out.size(); ++m)
    out[m] += ahead * (state_.rate[m] + 0.5 * ahead * acceleration_[m]);
  return out;
}

void ModalTreeState::pose(const BatchPoser& poser, Nanoseconds stamp, BatchPoses& out) const {
  BatchBends bends;
  batch_->bends(amplitudeAt(stamp), bends);
  poser.pose(bends, out);
}

namespace {

// Factors of values and rates at the ends of an interval in a cubic or one of its derivatives.
struct Hermite {
  double before, before_rate, after, after_rate;
};

void combine(const Hermite& by, const physics::ModalState& before, const physics::ModalState& after,
             std::vector<double>& out) {
  out.resize(after.amplitude.size());
  for (std::size_t m = 0; m < out.size(); ++m)
    out[m] = by.before * before.amplitude[m] + by.before_rate * before.rate[m] +
             by.after * after.amplitude[m] + by.after_rate * after.rate[m];
}

}  // namespace

void ModalTreeState::interpolateMotion(Nanoseconds stamp, ModalMotion& out) const {
  if (stamp_ == before_stamp_) {
    out.amplitude = amplitudeAt(stamp);
    out.rate = state_.rate;
    out.acceleration = acceleration_;
    return;
  }
  const double h = secondsBetween(before_stamp_, stamp_);
  const double u = secondsBetween(before_stamp_, stamp) / h, v = 1.0 - u;
  const double c = 6.0 * u * v / h, d = 6.0 * (v - u) / (h * h);
  combine({v * v * (1.0 + 2.0 * u), u * v * v * h, u * u * (1.0 + 2.0 * v), -(u * u * v) * h},
          before_, state_, out.amplitude);
  combine({-c, v * (v - 2.0 * u), c, u * (u - 2.0 * v)}, before_, state_, out.rate);
  combine({-d, (2.0 * u - 4.0 * v) / h, d, (4.0 * u - 2.0 * v) / h}, before_, state_,
          out.acceleration);
}

JointAngles bendOf(const ModalTree& modes, const std::vector<double>& amplitude, int branch) {
  JointAngles out;
  for (std::size_t m = 0; m < amplitude.size(); ++m) {
    const double* shape = modes.modes().shapeOf(m) + 2 * static_cast<std::size_t>(branch);
    out.first += amplitude[m] * shape[0];
    out.second += amplitude[m] * shape[1];
  }
  return limited(out);
}

JointAngles interpolate(const JointAngles& from, const JointAngles& to, double weight) {
  return {(1.0 - weight) * from.first + weight * to.first,
          (1.0 - weight) * from.second + weight * to.second};
}

std::vector<JointAngles> modalAngles(const Tree& tree, const wind::Instant& wind,
                                     const Weights& weights, const ModalTreeState* modal_state,
                                     Nanoseconds stamp) {
  const double weight = modal_state ? modalWeight(weights) : 0.0;
  if (weight <= 0.0) return proceduralAngles(tree, wind, weights);
  std::vector<JointAngles> out = modal_state->modes().bendsOf(modal_state->amplitudeAt(stamp));
  for (JointAngles& bends : out) bends = limited(bends);
  if (weight >= 1.0) return out;
  const std::vector<JointAngles> from = proceduralAngles(tree, wind, weights);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = interpolate(from[i], out[i], weight);
  return out;
}

}  // namespace vegetation_sim::forest
