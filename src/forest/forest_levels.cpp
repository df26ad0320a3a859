// Choice of the tier of each tree.
#include <algorithm>
#include <cmath>

#include "forest/forest.h"
#include "tree/lod/response_error.h"
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
// Memory for more is released: few scenes have as many near trees.
constexpr std::size_t MANY_PLANTS = 20000;

// Combines two independent errors.
double combine(double a, double b) {
  return std::sqrt(a * a + b * b);
}

}  // namespace

// Returns the speed to which bends are proportional.
double Forest::bendingSpeed(double speed, double reference_speed) const {
  const bool linear = layout_.motion.drag == Drag::LINEAR;
  return linear ? speed : speed * speed / reference_speed;
}

// Returns the pixels per metre of a level table of the camera that sees the ball best. A near robot
// counts as a camera with its tolerance in metres.
double Forest::pixelsPerMetreAt(const Vec3& centre, double reach) const {
  double out = 0.0;
  for (const auto& entry : snapshot_.viewers) {
    const Viewpoint& eye = entry.second.eye;
    if (!sees(eye, centre, 2.0 * reach)) continue;  // twice: the whole tree with a margin
    const double distance = length(eye.position - centre) - reach;
    out = std::max(out, pixelsPerMetre(eye, distance));
  }
  const Settings& settings = snapshot_.settings;
  for (const auto& entry : snapshot_.physics.bodies()) {
    const double distance = length(entry.second.pose.position - centre) - reach;
    if (distance < settings.robot_range)
      out = std::max(out, settings.tolerance / settings.robot_tolerance);
  }
  return SEEN * out;
}

void Forest::advance(Nanoseconds stamp) {
  advancePhysics(stamp);
  fine_due_ = ModalForest::fineDue(snapshot_.stamp, stamp);
  snapshot_.stamp = stamp;
  for (auto it = snapshot_.viewers.begin(); it != snapshot_.viewers.end();)
    it = stamp - it->second.stamp > VIEWER_LIFE ? snapshot_.viewers.erase(it) : std::next(it);
  chooseLevels();
  snapshot_.levels.prune(stamp, layout_.motion.transition);
  snapshot_.modes.removeFaded(snapshot_.levels, stamp, layout_.motion.transition);
}

void Forest::chooseLevels() {
  const Settings& settings = snapshot_.settings;
  const bool watched = !snapshot_.viewers.empty();
  const int base = watched ? 0 : std::min(settings.fixed_level, settings.highest_level);
  last_base_ = snapshot_.levels.base().level;
  snapshot_.levels.changeBase(base, snapshot_.stamp, layout_.motion.transition);
  plants_.clear();
  if (watched || !snapshot_.physics.bodies().empty()) {
    now_ = snapshot_.wind.at(snapshot_.stamp);
    swinging_ = wind::GustSpectrumField(snapshot_.wind, snapshot_.stamp);
    for (const Region& region : regions_) chooseRegion(region);
  }
  applyTiers();
}

// Visits a tile as a whole: if even its nearest and largest tree may stand still, its trees are not
// visited.
void Forest::chooseRegion(const Region& region) {
  if (region.count == 1) return chooseTree(region.first);
  const double speed =
      bendingSpeed(now_.speedBound(region.centre, region.reach), slowest_reference_);
  const double error = largest_omission_ * speed * pixelsPerMetreAt(region.centre, region.reach);
  if (error <= HYSTERESIS * snapshot_.settings.tolerance) return;
  for (std::uint32_t i = 0; i < region.count; ++i) chooseTree(region.first + i);
}

void Forest::chooseTree(std::uint32_t tree) {
  const TreeSeed seed = seedOf(layout_, tree);
  const LevelTable table = tables_[seed.species].at(seed.scale);
  const Vec3 foot = footOf(seed, *terrain_);
  const Vec3 middle = foot + Vec3(0.0, 0.0, 0.5 * table.height);
  const double view = pixelsPerMetreAt(middle, 0.5 * table.reach);  // where most of its twigs are
  const auto known = snapshot_.levels.held().find(tree);
  const bool held = known != snapshot_.levels.held().end();
  Plant plant;
  plant.id = tree;
  plant.held = held ? known->second.level : last_base_;
  const ModalTreeState* modal_states = snapshot_.modes.find(tree);
  if (plant.held == MODAL_LEVEL && modal_states && modal_states->fine())
    plant.held = FINE_MODAL_TIER;
  plant.resting = held && secondsBetween(known->second.since, snapshot_.stamp) < TIER_HOLD;
  predict(seed, table, view, plant);
  const int base = snapshot_.levels.base().level;
  plant.stepwise = std::max(plant.stepwise, base);
  plant.wanted = std::max(plant.wanted, base);
  if (plant.wanted != base || plant.held != base) plants_.push_back(plant);
}

// Predicts errors and costs of all tiers, and which of them the tolerance requires.
void Forest::predict(const TreeSeed& seed, const LevelTable& table, double view, Plant& plant) {
  const Settings& settings = snapshot_.settings;
  const Budget& budget = settings.budget;
  const Species& species = layout_.species[seed.species];
  const Vec3 foot = footOf(seed, *terrain_);
  const double air = now_.speedBound(foot, 0.5 * table.reach);
  const double speed = bendingSpeed(air, species.reference_speed);
  plant.stepwise = plant.wanted = std::min(
      chooseLevel(table, speed, view, settings.tolerance, plant.held), settings.highest_level);
  const double reach = 0.5 * table.reach, pixels = view / SEEN;
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
}

// Requests modes where the error of the procedural motion exceeds the tolerance and that of modes
// is smaller; fine ones where plain modes exceed it too. A tree with fine modes keeps them while it
// has modes, because the change back would be visible.
void Forest::requestModes(const PredictedError& off, Plant& plant) const {
  const double tolerance = snapshot_.settings.tolerance;
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
PredictedError Forest::responseErrorOf(const TreeSeed& seed, const wind::GustSpectrum& spectrum,
                                       double bending, double pixels) {
  const Species& species = layout_.species[seed.species];
  const PredictedError lag =
      tables_[seed.species].responseErrorAt(species, layout_.motion, seed.scale, spectrum);
  const double peak = bendingSpeed(spectrum.peak, species.reference_speed),
               mean = bendingSpeed(length(now_.mean), species.reference_speed);
  const double mended = std::max(0.0, lag.bend.procedural - lag.bend.modal) * mean * mean;
  const double rest = lag.bend.procedural * peak * peak, turned = rest - mended;
  return {pixels * combine(bending * lag.procedural, rest),
          pixels * combine(bending * lag.modal, rest), pixels * combine(bending * lag.fine, turned),
          lag.bend};
}

bool Forest::haveModes() const {
  return snapshot_.settings.budget.modal_trees > 0 &&
         snapshot_.settings.highest_level == MAX_DEPTHS &&
         layout_.motion.joint_model == JointModel::SWING;
}

void Forest::applyTiers() {
  const Settings& settings = snapshot_.settings;
  const Budget& budget = settings.budget;
  const double physical =
      1e-6 * budget.physical_cost * static_cast<double>(physicsFigures().branches);
  shareModes(plants_, budget.modal_trees, budget.state_bytes);
  static_cast<TierAllocation&>(governor_) =
      allocateTiers(plants_, std::max(0.0, budget.frame_time - physical), settings.tolerance);
  governor_.physical = physical;
  governor_.cost += physical;
  governor_.budget = budget.frame_time;
  governor_.strained = snapshot_.modes.countStrained();
  startModes();
  std::vector<std::uint32_t> chosen, held;
  for (const Plant& plant : plants_) {
    setTreeLevel(plant.id, std::min(plant.chosen, MODAL_LEVEL));
    chosen.push_back(plant.id);
  }
  std::sort(chosen.begin(), chosen.end());
  for (const auto& entry : snapshot_.levels.held()) held.push_back(entry.first);
  for (const std::uint32_t tree : held)
    if (!std::binary_search(chosen.begin(), chosen.end(), tree))
      setTreeLevel(tree, snapshot_.levels.base().level);
  if (plants_.size() > MANY_PLANTS) std::vector<Plant>().swap(plants_);
}

// Computing modes takes milliseconds: one tree per tick gets plain modes, that with the largest
// error first; if none does, one gets fine modes at its turn. Other trees wait on their present
// tier. A tree with fine modes that is to have plain ones returns to its levels until the modes
// have faded, because the change would be visible.
void Forest::startModes() {
  Plant *plain = nullptr, *finer = nullptr;
  const auto wait = [](Plant& plant, int tier, Plant*& first) {
    plant.chosen = tier;
    if (!first || plant.error[0] > first->error[0]) first = &plant;
  };
  for (Plant& plant : plants_) {
    if (plant.chosen < MODAL_LEVEL) continue;
    const ModalTreeState* modal_state = snapshot_.modes.find(plant.id);
    if (!modal_state)
      wait(plant, plant.stepwise, plant.chosen == FINE_MODAL_TIER ? finer : plain);
    else if (!modal_state->fine() && plant.chosen == FINE_MODAL_TIER)
      wait(plant, MODAL_LEVEL, finer);
    else if (modal_state->fine() && plant.chosen == MODAL_LEVEL)
      plant.chosen = plant.stepwise;
  }
  Plant* const next = plain ? plain : fine_due_ ? finer : nullptr;
  if (!next) return;
  snapshot_.modes.addTree({layout_, *terrain_, snapshot_.wind}, next->id, next == finer,
                          snapshot_.stamp);
  snapshot_.changed.insert(next->id);
  snapshot_.begun.insert(next->id);
  next->chosen = next == finer ? FINE_MODAL_TIER : MODAL_LEVEL;
}

void Forest::setTreeLevel(std::uint32_t tree, int level) {
  LevelState state = snapshot_.levels.of(tree);
  if (state.level == level) return;
  setLevel(state, level, snapshot_.stamp, layout_.motion.transition);
  snapshot_.levels.set(tree, state);
  snapshot_.changed.insert(tree);
}

}  // namespace vegetation_sim::forest
