// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/detail/tier_predictor.h"

#include <algorithm>
#include <cmath>

#include "wind/laws.h"

namespace vegetation_sim::forest {
namespace {

// Ratio of the visible error of a forest to that of a level table, which is the worst tip of the
// worst tree across the wind. Measured by forest_test, PredictedErrorIsTheMeasuredOne.
constexpr double SEEN = 0.57;
// Errors within this ratio count as equal.
constexpr double ALIKE = 1.1;
// Fine modes are used where their error is below this fraction of that of plain modes.
constexpr double BETTER = 0.9;

// Combines two independent errors.
double combine(double a, double b) {
  return std::sqrt(a * a + b * b);
}

}  // namespace

// Returns the speed to which bends are proportional.
double TierPredictor::bendingSpeed(double speed, double reference_speed) const {
  const bool linear = context_.layout.motion.drag == Drag::LINEAR;
  return linear ? speed : speed * speed / reference_speed;
}

bool TierPredictor::mayRest(const Ball& region, const DetailDemand& demand) const {
  const double tolerance = context_.settings.tolerance;
  const double speed = bendingSpeed(now_.speedBound(region.centre, region.reach, steady_),
                                    context_.errors.slowestReference());
  const double view = SEEN * demand.pixelsPerMetre(region.centre, region.reach, tolerance);
  return context_.errors.largestOmission() * speed * view <= HYSTERESIS * tolerance;
}

bool TierPredictor::predict(const TreeSeed& seed, const DetailDemand& demand, Plant& plant) const {
  const Settings& settings = context_.settings;
  const Budget& budget = settings.budget;
  const Species& species = context_.layout.species[seed.species];
  const LevelTable table = context_.errors.tableOf(seed);
  const Vec3 foot = footOf(seed, context_.terrain);
  const Vec3 middle = foot + Vec3(0.0, 0.0, 0.5 * table.height);  // where most of its twigs are
  const double reach = 0.5 * table.reach;
  const double pixels = demand.pixelsPerMetre(middle, reach, settings.tolerance);
  const double view = SEEN * pixels;
  plant.scale = pixels;
  const double air = now_.speedBound(foot, reach, steady_);
  const double speed = bendingSpeed(air, species.reference_speed);
  plant.stepwise = plant.wanted = std::min(
      chooseLevel(table, speed, view, settings.tolerance, plant.held), settings.highest_level);
  if (plant.stepwise == 0 && plant.held == demand.base) return false;
  PredictedError off, besides;
  if (plant.stepwise > 0) {
    off = besides = responseErrorOf(seed, swinging_.at(foot, reach), speed / air, pixels);
    // Disks are the winds of paper 1, whose complete response is in the levels (S1-41), so they do
    // not request modes.
    if (swinging_.hasDisks())
      besides = responseErrorOf(seed, swinging_.withoutDisks(foot, reach), speed / air, pixels);
  }
  for (std::size_t tier = 0; tier < table.omitted.size(); ++tier) {
    const double omitted = speed * view * table.omitted[tier];
    plant.error[tier] = static_cast<float>(std::max(omitted, off.procedural));
    const double moving = tier > 0 ? budget.tree_cost : 0.0;
    plant.cost[tier] =
        static_cast<float>(1e-6 * (moving + budget.procedural_cost * table.branches[tier]));
  }
  const auto report = [&](int tier, double error, double cost) {
    const auto at = static_cast<std::size_t>(tier);
    plant.error[at] = static_cast<float>(std::min(error, off.procedural));
    plant.cost[at] = static_cast<float>(1e-6 * (budget.tree_cost + cost * table.branches.back()));
  };
  report(MODAL_LEVEL, off.modal, budget.modal_cost);
  report(FINE_MODAL_TIER, std::min(off.modal, off.fine), budget.fine_cost);
  requestModes(besides, plant);
  plant.stepwise = std::max(plant.stepwise, demand.base);
  plant.wanted = std::max(plant.wanted, demand.base);
  return plant.wanted != demand.base || plant.held != demand.base;
}

// Requests modes where the error of the procedural motion exceeds the tolerance and that of modes
// is smaller; fine ones where plain modes exceed it too. A tree with fine modes keeps them while it
// has modes, because the change back would be visible.
void TierPredictor::requestModes(const PredictedError& off, Plant& plant) const {
  const double tolerance = context_.settings.tolerance;
  const bool has = plant.held >= MODAL_LEVEL;
  if (!haveModes() || off.procedural <= (has ? HYSTERESIS : 1.0) * tolerance) return;
  const double alike = ALIKE * (has ? 1.05 : 1.0) * off.procedural;
  const bool held = plant.held == FINE_MODAL_TIER, helps = off.modal < alike && !held;
  const bool finer = held || (off.fine < BETTER * off.modal && (off.modal > tolerance || !helps));
  plant.above = helps ? MODAL_LEVEL : FINE_MODAL_TIER;
  if (finer && off.fine < alike)
    plant.wanted = FINE_MODAL_TIER;
  else if (helps)
    plant.wanted = MODAL_LEVEL;
}

// Returns the error of a tree in gusts and by its bend [pixel]; `bending` is the bending speed per
// wind speed. The correction by rotated lever arms is known for steady wind only: modes omit that a
// moving tree has a bent inertia too. Fine modes are therefore predicted with the bend error of
// plain modes in the mean wind, and plain modes as if lever arms were fixed.
PredictedError TierPredictor::responseErrorOf(const TreeSeed& seed,
                                              const wind::GustSpectrum& spectrum, double bending,
                                              double pixels) const {
  const Species& species = context_.layout.species[seed.species];
  const PredictedError lag = context_.errors.responseErrorOf(context_.layout, seed, spectrum);
  const double peak = bendingSpeed(spectrum.peak, species.reference_speed),
               mean = bendingSpeed(length(now_.mean), species.reference_speed);
  const double mended = std::max(0.0, lag.bend.procedural - lag.bend.modal) * mean * mean;
  const double rest = lag.bend.procedural * peak * peak, turned = rest - mended;
  return {pixels * combine(bending * lag.procedural, rest),
          pixels * combine(bending * lag.modal, rest), pixels * combine(bending * lag.fine, turned),
          lag.bend};
}

bool TierPredictor::haveModes() const {
  return context_.settings.budget.modal_trees > 0 &&
         context_.settings.highest_level == MAX_DEPTHS &&
         context_.layout.motion.joint_model == JointModel::SWING;
}

}  // namespace vegetation_sim::forest
