// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The step of the physical part of a tree.
#include <cmath>

#include "tree/physical/physical_subtree.h"
#include "vegetation_sim/core/math/math.h"
#include "wind/sampling/batch_wind.h"

namespace vegetation_sim::forest {
namespace {

// Chains limit the bends of their joints up to rounding.
constexpr double BEND_ROUNDING = 1.0 + 1e-6;

// Velocity products are predicted instead of averaged where no joint turns farther in a step [rad].
constexpr double PREDICTED_TURN = 0.01;

}  // namespace

/// Callbacks of the stepper during one step.
struct PhysicalSubtree::Step {
  const PhysicalSubtree& part;
  const TreeWind& air;
  const SubtreeLoads& loads;
  const PhysicsSettings& settings;
  SubtreeScratch& scratch;
  Nanoseconds from;
  mutable Nanoseconds based{NEVER};  // stamp of scratch.bases

  Nanoseconds stampAt(double time) const { return from + fromSeconds(time); }
  void updateBases(Nanoseconds stamp) const {
    if (based == stamp) return;
    part.baseMotions(air, stamp, scratch, scratch.bases);
    based = stamp;
  }
  void bases(double time, std::vector<physics::BaseMotion>& out) const {
    updateBases(stampAt(time));
    out = scratch.bases;
  }
  void load(const physics::Kinematics& kinematics, double time, physics::Loads& out) const {
    out.clear(part.links_.size());
    part.addWind(scratch.sampleAt(air.field, stampAt(time)), kinematics, settings, scratch, out);
    addOthers(stampAt(time), kinematics, out);
  }
  // Fills the wind rows of a chain.
  void fillWindRows(double h, const float* places, float* rows, std::size_t blocks) const {
    const bool own = loads.air == NEVER || part.compensates(from, settings.fade);
    const Nanoseconds stamp = own ? stampAt(part.theta_ * h) : loads.air;
    const wind::Instant& now = scratch.sampleAt(air.field, stamp).now();
    fillWind(FloatWind(now.relativeTo(part.tree().foot), LARGEST_TREE), places, rows, blocks);
  }
  // Adds all loads but the wind.
  void addOthers(Nanoseconds stamp, const physics::Kinematics& kinematics,
                 physics::Loads& out) const {
    updateBases(stamp);
    part.addCompensation(air, stamp, settings, scratch, out);
    part.addSprings(loads, stamp, kinematics, out);
    part.addForces(loads, kinematics, out);
  }
  physics::Surroundings outside() const {
    physics::Surroundings out;
    out.bases = [this](double time, std::vector<physics::BaseMotion>& to) { bases(time, to); };
    out.loads = [this](const physics::Kinematics& kinematics, double time, physics::Loads& to) {
      load(kinematics, time, to);
    };
    return out;
  }
  // Surroundings of a chain that has the wind in its own rows.
  physics::Surroundings outsideWind() const {
    physics::Surroundings out;
    if (!part.carriers_.empty())
      out.bases = [this](double time, std::vector<physics::BaseMotion>& to) { bases(time, to); };
    if (loads.springs.empty() && loads.forces.empty() && !part.compensates(from, settings.fade))
      return out;
    out.loads = [this](const physics::Kinematics& kinematics, double time, physics::Loads& to) {
      addOthers(stampAt(time), kinematics, to);
    };
    return out;
  }
};

void PhysicalSubtree::step(const TreeWind& air, const SubtreeLoads& loads,
                           const PhysicsSettings& settings, Nanoseconds from, Nanoseconds to,
                           SubtreeScratch& scratch) {
  const Step context{*this, air, loads, settings, scratch, from};
  const double h = secondsBetween(from, to);
  if (settings.precision == Precision::SINGLE &&
      settings.dynamics == physics::Dynamics::ARTICULATED &&
      settings.integrator == physics::Integrator::MIDPOINT)
    return stepBatched(context, h);
  const physics::Surroundings outside = context.outside();
  scratch.stepper.setDynamics(settings.dynamics);
  physics::ChainState& state = state_.change();
  if (scratch.stepper.step(settings.integrator, links_, outside, 0.0, h, state, theta_) == 0) {
    ++scratch.replaced;  // beyond the bound of the explicit method
    scratch.stepper.step(physics::Integrator::MIDPOINT, links_, outside, 0.0, h, state, theta_);
  }
  limitJoints();
}

// The state stays in the chain. Only rows that follow from the state are there besides, except for
// those that steps of one tick share, so that a copy without chain continues with the same bits.
void PhysicalSubtree::stepBatched(const Step& context, double h) {
  if (!state_.chain()) createChain();
  physics::BatchChain& chain = state_.loadChain(theta_);
  chain.setScratch(context.scratch.chain);
  // Compensation needs the wind of each step.
  if (!context.loads.hold || compensates(context.from, context.settings.fade))
    chain.queryWind([&](const float* places, float* rows, std::size_t blocks) {
      context.fillWindRows(h, places, rows, blocks);
    });
  if (!compensates(context.from, context.settings.fade))
    chain.setLoadedLinks(&listLoaded(context.loads, context.scratch));
  const bool predicts = context.loads.hold && h * chain.fastest(0) <= PREDICTED_TURN;
  chain.step(context.outsideWind(), 0.0, h, predicts ? 1 : 0);
  state_.followChain();
  theta_ = chain.theta(0);
  if (chain.isWithin(BEND_ROUNDING * LARGEST_BEND, FASTEST_BEND)) return;
  limitJoints();
  context.scratch.chain.clear();  // values that are not finite would reach other trees
}

void PhysicalSubtree::createChain() {
  auto chain = std::make_unique<physics::BatchChain>(links_);
  const bool linear = tree_->drag == Drag::LINEAR;
  std::vector<physics::Grip> grips;
  for (const LinkDrag& drag : drags_)
    grips.push_back({drag.centre, linear ? drag.force : 0.0,
                     linear ? 0.0 : drag.force / tree_->reference_speed});
  chain->setGrips(0, grips);
  state_.setChain(std::move(chain));
}

// Keeps angles and rates within the limits of chains and messages: the printed dynamics oscillate
// without bound (E2), and a grab may bend a twig beyond any limit.
void PhysicalSubtree::limitJoints() {
  physics::ChainState& state = state_.change();
  for (std::size_t i = 0; i < links_.size(); ++i) {
    physics::Vec2 &q = state.q[i], &rate = state.rate[i];
    const double bend = std::sqrt(q.x() * q.x() + q.y() * q.y());
    const double speed = std::sqrt(rate.x() * rate.x() + rate.y() * rate.y());
    if (bend <= BEND_ROUNDING * LARGEST_BEND && speed <= FASTEST_BEND) continue;  // false for NaN
    const bool finite = std::isfinite(bend) && std::isfinite(speed);
    if (!finite || bend > LARGEST_BEND) rate = {0.0, 0.0};
    if (!finite) q = {0.0, 0.0};
    if (finite && bend > LARGEST_BEND) q *= LARGEST_BEND / bend;
    if (finite && bend <= LARGEST_BEND) rate *= FASTEST_BEND / speed;
  }
}

void PhysicalSubtree::stepWithContacts(const TreeWind& air, const SubtreeLoads& loads,
                                       const PhysicsSettings& settings, Nanoseconds from,
                                       Nanoseconds to, SubtreeScratch& scratch,
                                       std::vector<physics::Contact>& contacts) {
  const Step context{*this, air, loads, settings, scratch, from};
  const double h = secondsBetween(from, to);
  physics::ChainState& state = state_.change();
  theta_ = physics::guardedTheta(state, h, theta_);
  const bool euler = settings.integrator == physics::Integrator::IMPLICIT_EULER;
  scratch.contact_stepper.step(links_, context.outside(), settings.contact, 0.0, h,
                               euler ? 1.0 : theta_, state, contacts);
  limitJoints();
}

}  // namespace vegetation_sim::forest
