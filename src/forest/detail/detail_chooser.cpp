// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/detail/detail_chooser.h"

#include <algorithm>
#include <limits>

namespace vegetation_sim::forest {
namespace {

// Memory for more is released: few scenes have as many near trees.
constexpr std::size_t MANY_PLANTS = 20000;
// Time after which the modes of a large tree start, per branch [s]: twice what computing them
// takes.
constexpr double PLAIN_DELAY = 2e-5, FINE_DELAY = 1e-4;

double branchesOf(const PredictionContext& context, std::uint32_t tree) {
  return context.errors.tableOf(seedOf(context.layout, tree)).branches.back();
}

}  // namespace

void DetailChooser::choose(const PredictionContext& context, const DetailDemand& demand,
                           double physical_cost, const Start& start, TreeDetail& detail) {
  const double transition = context.layout.motion.transition;
  const int last_base = detail.levels.base().level;
  detail.levels.changeBase(demand.base, context.stamp, transition);
  plants_.clear();
  if (!demand.empty()) findPlants(context, demand, last_base, detail);
  allocate(context.settings, demand, physical_cost);
  figures_.strained = detail.modes.countStrained();
  startModes(context, start, detail);
  setLevels(context, demand.most_changes, detail);
  detail.prune(context.stamp, transition);
  if (plants_.size() > MANY_PLANTS) std::vector<Plant>().swap(plants_);
}

// Visits trees that stand together as a whole: if even the nearest and largest may stand still,
// they are not visited. A tree outside tiles that is held is visited in any case, since its time at
// a level may not have passed yet.
void DetailChooser::findPlants(const PredictionContext& context, const DetailDemand& demand,
                               int last_base, const TreeDetail& detail) {
  const TierPredictor predictor(context);
  const auto outside_tiles = static_cast<std::uint32_t>(context.layout.trees.size());
  const auto add = [&](std::uint32_t tree) {
    addPlant(predictor, context, demand, last_base, detail, tree);
  };
  for (const auto& entry : detail.levels.held())
    if (entry.first < outside_tiles) add(entry.first);
  context.errors.regions().visit([&](const Ball& ball) { return !predictor.mayRest(ball, demand); },
                                 [&](const TreeRegions::Region& region) {
                                   for (std::uint32_t tree = region.first;
                                        tree < region.first + region.count; ++tree)
                                     if (tree >= outside_tiles || !detail.levels.held().count(tree))
                                       add(tree);
                                 });
  std::sort(plants_.begin(), plants_.end(),
            [](const Plant& a, const Plant& b) { return a.id < b.id; });
}

// Adds a tree unless it is and stays at the base level. `last_base` was the level of the trees that
// are not held.
void DetailChooser::addPlant(const TierPredictor& predictor, const PredictionContext& context,
                             const DetailDemand& demand, int last_base, const TreeDetail& detail,
                             std::uint32_t tree) {
  const auto known = detail.levels.held().find(tree);
  const bool held = known != detail.levels.held().end();
  Plant plant;
  plant.id = tree;
  plant.held = held ? known->second.level : last_base;
  const ModalTreeState* modal_state = detail.modes.find(tree);
  if (plant.held == MODAL_LEVEL && modal_state && modal_state->fine()) plant.held = FINE_MODAL_TIER;
  plant.resting = held && secondsBetween(known->second.since, context.stamp) < TIER_HOLD;
  if (predictor.predict(seedOf(context.layout, tree), demand, plant)) plants_.push_back(plant);
}

void DetailChooser::allocate(const Settings& settings, const DetailDemand& demand,
                             double physical_cost) {
  const Budget& budget = settings.budget;
  const double room = demand.frame_time_binds ? std::max(0.0, budget.frame_time - physical_cost)
                                              : std::numeric_limits<double>::infinity();
  shareModes(plants_, budget.modal_trees, budget.state_bytes);
  static_cast<TierAllocation&>(figures_) = allocateTiers(plants_, room, settings.tolerance);
  figures_.physical = physical_cost;
  figures_.cost += physical_cost;
  figures_.budget = budget.frame_time;
}

// Other trees than those that start wait on their present tier. A tree with fine modes that is to
// have plain ones returns to its levels until the modes have faded, because the change would be
// visible.
DetailChooser::Candidates DetailChooser::findCandidates(const PredictionContext& context,
                                                        const Start& start,
                                                        const TreeDetail& detail) {
  Candidates out;
  const auto wait = [&](Plant& plant, int tier, bool fine) {
    plant.chosen = tier;
    if (detail.request && detail.request->tree == plant.id && detail.request->fine == fine)
      out.requested = {&plant, fine};
    const bool known = start.known && start.known->find(plant.id, fine);
    Candidate& first = !known && branchesOf(context, plant.id) > LARGE ? out.large
                       : fine                                          ? out.finer
                                                                       : out.plain;
    if (!first.plant || plant.error[0] > first.plant->error[0]) first = {&plant, fine};
  };
  for (Plant& plant : plants_) {
    if (plant.chosen < MODAL_LEVEL) continue;
    const bool fine = plant.chosen == FINE_MODAL_TIER;
    const ModalTreeState* modal_state = detail.modes.find(plant.id);
    if (!modal_state)
      wait(plant, plant.stepwise, fine);
    else if (!modal_state->fine() && fine)
      wait(plant, MODAL_LEVEL, true);
    else if (modal_state->fine() && !fine)
      plant.chosen = plant.stepwise;
  }
  return out;
}

// One tree per tick gets plain modes, that with the largest error first; if none does, one gets
// fine modes at its turn. Those whose turn comes later are computed in advance, which changes no
// result. A large tree is the only one in its tick.
void DetailChooser::startModes(const PredictionContext& context, const Start& start,
                               TreeDetail& detail) {
  const ModalContext at{context.layout, context.terrain, context.wind, context.broken};
  const Candidates candidates = findCandidates(context, start, detail);
  has_computed_ = false;
  awaited_.clear();
  const bool started = startRequested(at, start, candidates, context, detail);
  const Candidate next = started                  ? Candidate{}
                         : candidates.plain.plant ? candidates.plain
                         : start.fine             ? candidates.finer
                                                  : Candidate{};
  if (candidates.finer.plant && next.plant != candidates.finer.plant) {
    const ModesWorker::Key key{candidates.finer.plant->id, true};
    if (start.worker->isIdle()) start.worker->begin(at, key);
    awaited_.insert(key);
  }
  if (!next.plant) return;
  const ModalTreeState* like = start.known ? start.known->find(next.plant->id, next.fine) : nullptr;
  if (!like && !start.compute) return;
  has_computed_ = !like;
  if (!like) like = start.worker->find(at, {next.plant->id, next.fine});
  this->start(at, next, context.stamp, like, detail);
}

// Requests the modes of one large tree at a time. Returns whether they have started.
bool DetailChooser::startRequested(const ModalContext& at, const Start& start,
                                   const Candidates& candidates, const PredictionContext& context,
                                   TreeDetail& detail) {
  std::optional<ModesRequest>& request = detail.request;
  if (!candidates.requested.plant) request.reset();
  if (!request && candidates.large.plant) {
    const auto [plant, fine] = candidates.large;
    const double delay = branchesOf(context, plant->id) * (fine ? FINE_DELAY : PLAIN_DELAY);
    request = {plant->id, fine, context.stamp + fromSeconds(delay)};
  }
  if (!request) return false;
  const ModesWorker::Key key{request->tree, request->fine};
  start.worker->begin(at, key);
  const bool is_due = context.stamp >= request->due && (start.fine || !request->fine);
  if (!is_due || !candidates.requested.plant) {
    awaited_.insert(key);
    return false;
  }
  this->start(at, candidates.requested, context.stamp, start.worker->find(at, key), detail);
  request.reset();
  return true;
}

void DetailChooser::start(const ModalContext& at, const Candidate& candidate, Nanoseconds stamp,
                          const ModalTreeState* like, TreeDetail& detail) const {
  const std::uint32_t tree = candidate.plant->id;
  detail.modes.addTree(at, tree, candidate.fine, stamp, like);
  detail.changed.insert(tree);
  detail.begun.insert(tree);
  candidate.plant->chosen = candidate.fine ? FINE_MODAL_TIER : MODAL_LEVEL;
}

// Modes begin with their level. Trees that are not among the plants, which are in order of their
// ids, return to the base after all others.
std::vector<DetailChooser::Change> DetailChooser::listChanges(const TreeDetail& detail) const {
  constexpr double FIRST = std::numeric_limits<double>::infinity();
  std::vector<Change> out;
  for (const Plant& plant : plants_) {
    const int level = std::min(plant.chosen, MODAL_LEVEL);
    const int last = detail.levels.of(plant.id).level;
    if (last == level) continue;
    const auto errorAt = [&](int tier) {
      return static_cast<double>(plant.error[static_cast<std::size_t>(tier)]);
    };
    const double saved = errorAt(last) - errorAt(plant.chosen);
    out.push_back({plant.id, level, detail.begun.count(plant.id) > 0 ? FIRST : saved});
  }
  const int base = detail.levels.base().level;
  const auto isPlant = [&](std::uint32_t tree) {
    const auto at = std::lower_bound(plants_.begin(), plants_.end(), tree,
                                     [](const Plant& a, std::uint32_t id) { return a.id < id; });
    return at != plants_.end() && at->id == tree;
  };
  for (const auto& [tree, state] : detail.levels.held())
    if (state.level != base && !isPlant(tree)) out.push_back({tree, base, -FIRST});
  return out;
}

// Changes beyond the number that is allowed wait for the next ticks.
void DetailChooser::setLevels(const PredictionContext& context, std::size_t most,
                              TreeDetail& detail) const {
  std::vector<Change> changes = listChanges(detail);
  if (changes.size() > most) {
    std::sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) {
      return a.saved > b.saved || (a.saved == b.saved && a.tree < b.tree);
    });
    changes.resize(most);
  }
  for (const Change& change : changes)
    detail.setLevel(change.tree, change.level, context.stamp, context.layout.motion.transition);
}

}  // namespace vegetation_sim::forest
