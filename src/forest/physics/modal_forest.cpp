// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/physics/modal_forest.h"

#include <algorithm>

#include "core/archive/archive.h"
#include "tree/growth/physics_settings.h"
#include "tree/physical/procedural_motion.h"
#include "tree/state/tree_hashes.h"

namespace vegetation_sim::forest {
namespace {

constexpr double QUICK = 30.0;  // [rad/s]

std::size_t modalSteps(Nanoseconds from, Nanoseconds to) {
  const Nanoseconds steps =
      ((to - from) * ModalForest::RATE + NANOSECONDS_PER_SECOND / 2) / NANOSECONDS_PER_SECOND;
  return static_cast<std::size_t>(std::max<Nanoseconds>(1, steps));
}

// A tree with few branches gets all its modes.
ModalTreeState modesOfTree(const Tree& tree, const Species& species, bool fine) {
  const bool few = 2 * tree.skeleton.branches.size() <= ModalDepth{}.most();
  return ModalTreeState(
      std::make_shared<const ModalTree>(tree, species, fine || few ? FINE_MODES : ModalDepth{}));
}

const BrokenBranches& brokenIn(const ModalContext& at, std::uint32_t id) {
  static const BrokenTrees NONE;
  return brokenOf(at.broken ? *at.broken : NONE, id);
}

void addAmplitudes(Hash& hash, const physics::ModalState& state) {
  for (const double a : state.amplitude) hash.add(a);
  for (const double r : state.rate) hash.add(r);
}

ModalTreeState modalStateOf(const ModalContext& at, std::uint32_t id, bool fine) {
  const Tree tree = growTree(at.layout, id, at.terrain, brokenIn(at, id));
  return modesOfTree(tree, at.layout.species[tree.seed.species], fine);
}

}  // namespace

void ModalForest::advance(const wind::Field& wind, Nanoseconds from, Nanoseconds to) {
  if (modal_states_.empty()) return;
  if (to <= from || to - from > LONGEST_GAP) {
    for (auto& entry : modal_states_) start(wind, entry.second, to);
    return;
  }
  const std::size_t steps = modalSteps(from, to);
  instants_.resize(steps + 1);
  for (std::size_t i = 0; i <= steps; ++i)
    wind.at(from + (to - from) * static_cast<Nanoseconds>(i) / static_cast<Nanoseconds>(steps),
            instants_[i]);
  loads_.resize(steps + 1);
  for (auto& [tree, modal_state] : modal_states_) {
    if (modal_state.stamp() != from) {
      start(wind, modal_state, to);
      continue;
    }
    for (std::size_t i = 0; i <= steps; ++i) modal_state.loadOf(instants_[i], loads_[i]);
    modal_state.step(loads_, to);
  }
}

void ModalForest::start(const wind::Field& wind, ModalTreeState& modal_state, Nanoseconds stamp) {
  std::array<ModalLoad, 3> loads;
  WindWindow window;
  window.sampleAt(wind, stamp);
  for (std::size_t look = 0; look < loads.size(); ++look)
    modal_state.loadOf(window.instants()[look], loads[look]);
  modal_state.begin(loads, secondsBetween(0, WINDOW_STEP), stamp);
}

void ModalForest::addTree(const ModalContext& at, std::uint32_t tree, bool fine, Nanoseconds stamp,
                          const ModalTreeState* like) {
  const auto fresh = [&] { return like ? *like : modalStateOf(at, tree, fine); };
  const auto found = modal_states_.find(tree);
  if (found == modal_states_.end())
    start(at.wind, modal_states_.emplace(tree, fresh()).first->second, stamp);
  else if (fine && !found->second.fine())
    refine(at.wind, fresh(), found->second);
}

// Bends and rates are continuous. Modes that are too fast for a tick start at the equilibrium of
// the load, otherwise they would oscillate visibly.
void ModalForest::refine(const wind::Field& wind, ModalTreeState fine,
                         ModalTreeState& modal_state) {
  const auto published = [&](const std::vector<double>& amplitudes) {
    return fine.modes().amplitudesOf(modal_state.modes().bendsOf(amplitudes));
  };
  ModalLoad load;
  fine.loadOf(wind.at(modal_state.stamp()), load);
  physics::ModalState state{published(modal_state.state().amplitude),
                            published(modal_state.state().rate)};
  std::vector<double> force;
  fine.addLeverForces(load, state, force);
  for (std::size_t m = 0; m < force.size(); ++m) {
    const double frequency = fine.modes().modes().frequency[m];
    if (frequency < QUICK) continue;
    state.amplitude[m] = force[m] / (frequency * frequency);
    state.rate[m] = 0.0;
  }
  fine.restore(state, load, modal_state.stamp());
  modal_state = std::move(fine);
}

bool ModalForest::isReady(std::uint32_t tree, std::size_t modes) const {
  const auto held = [&](const std::map<std::uint32_t, ModalTreeState>& modal_states) {
    const auto found = modal_states.find(tree);
    return found != modal_states.end() && found->second.modes().size() == modes;
  };
  return modes <= ModalDepth{}.most() || held(modal_states_) || held(prepared_);
}

void ModalForest::queueFineModes(std::uint32_t tree) {
  modal_states_.erase(tree);
  awaited_.insert(tree);
}

void ModalForest::prepareNext(const ModalContext& at) {
  if (awaited_.empty()) return;
  const std::uint32_t tree = *awaited_.begin();
  prepared_.insert_or_assign(tree, modalStateOf(at, tree, true));
  awaited_.erase(tree);
}

// The number of amplitudes identifies the kind of modes.
void ModalForest::restore(const ModalContext& at, std::uint32_t tree,
                          const physics::ModalState& state, Nanoseconds stamp) {
  const std::size_t count = state.amplitude.size();
  const auto has = [count](const auto& found, const auto& modal_states) {
    return found != modal_states.end() && found->second.modes().size() == count;
  };
  const auto found = modal_states_.find(tree), prepared = prepared_.find(tree);
  const bool fine = count > ModalDepth{}.most();
  if (!has(found, modal_states_))
    modal_states_.insert_or_assign(tree, has(prepared, prepared_) ? std::move(prepared->second)
                                                                  : modalStateOf(at, tree, fine));
  if (prepared != prepared_.end()) prepared_.erase(prepared);
  awaited_.erase(tree);
  ModalTreeState& modal_state = modal_states_.at(tree);
  ModalLoad load;
  modal_state.loadOf(at.wind.at(stamp), load);
  modal_state.restore(state, load, stamp);
}

void ModalForest::removeFaded(const LevelMap& levels, Nanoseconds stamp, double transition) {
  retainIf([&](std::uint32_t tree) {
    const LevelState level = levels.of(tree);
    return level.level >= MODAL_LEVEL || modalWeight(blendAt(level, stamp, transition)) > 0.0;
  });
}

void ModalForest::retain(const std::set<std::uint32_t>& trees) {
  retainIf([&](std::uint32_t tree) { return trees.count(tree) > 0; });
}

const ModalTreeState* ModalForest::replaceModes(const ModalContext& at, std::uint32_t tree,
                                                const ModalTreeState* like) {
  const auto found = modal_states_.find(tree);
  if (found == modal_states_.end()) return nullptr;
  ModalTreeState state = std::move(found->second);
  removeTree(tree);
  refine(at.wind, like ? *like : modalStateOf(at, tree, false), state);
  return &modal_states_.insert_or_assign(tree, std::move(state)).first->second;
}

void ModalForest::removeTree(std::uint32_t tree) {
  retainIf([=](std::uint32_t other) { return other != tree; });
}

void ModalForest::clear() {
  retainIf([](std::uint32_t) { return false; });
}

template <class Wanted>
void ModalForest::retainIf(const Wanted& wanted) {
  for (auto* each : {&modal_states_, &prepared_})
    for (auto it = each->begin(); it != each->end();)
      it = wanted(it->first) ? std::next(it) : each->erase(it);
  for (auto it = awaited_.begin(); it != awaited_.end();)
    it = wanted(*it) ? std::next(it) : awaited_.erase(it);
}

const ModalTreeState* ModalForest::find(std::uint32_t tree) const {
  const auto found = modal_states_.find(tree);
  return found == modal_states_.end() ? nullptr : &found->second;
}

const ModalTreeState* ModalForest::find(std::uint32_t tree, bool fine) const {
  const ModalTreeState* out = find(tree);
  const bool same = out && (fine ? out->fine() : out->modes().size() <= ModalDepth{}.most());
  return same ? out : nullptr;
}

std::size_t ModalForest::bytes() const {
  std::size_t out = 0;
  for (const auto* each : {&modal_states_, &prepared_})
    for (const auto& entry : *each) out += entry.second.bytes();
  return out;
}

std::size_t ModalForest::countStrained() const {
  return static_cast<std::size_t>(std::count_if(
      modal_states_.begin(), modal_states_.end(),
      [](const auto& entry) { return !entry.second.modes().probe().holds(entry.second.state()); }));
}

void ModalForest::addTo(Hash& hash) const {
  for (const auto& [tree, modal_state] : modal_states_) {
    hash.add(static_cast<std::uint64_t>(tree));
    addAmplitudes(hash, modal_state.state());
  }
}

void ModalForest::addTo(TreeHashes& hashes) const {
  for (const auto& [tree, modal_state] : modal_states_)
    addAmplitudes(hashes.of(tree, TreeHashes::MODES), modal_state.state());
}

ModalTreeState ModalForest::computeModes(const ModalContext& at, std::uint32_t tree,
                                         std::size_t modes) {
  ModalTreeState out = modalStateOf(at, tree, modes > ModalDepth{}.most());
  if (out.modes().size() != modes)
    throw InvalidInput("modes of tree " + std::to_string(tree) + " = " + std::to_string(modes) +
                       ", allowed are " + std::to_string(out.modes().size()));
  return out;
}

std::function<ModalTreeState()> ModalForest::prepareModes(const ModalContext& at, std::uint32_t id,
                                                          bool fine) {
  const TreeSeed seed = seedOf(at.layout, id);
  return [seed, species = at.layout.species.at(seed.species), law = at.layout.motion,
          foot = footOf(seed, at.terrain), broken = brokenIn(at, id),
          fine] { return modesOfTree(growTree(seed, species, law, foot, broken), species, fine); };
}

void ModalForest::archive(Archive& a, std::size_t trees, const ModesOf& modes_of) {
  constexpr std::size_t TREE_BYTES = 40;
  const std::size_t count = a.length("modal trees", modal_states_.size(), trees, TREE_BYTES);
  const auto each = [&](std::uint32_t tree, std::uint32_t modes, ModalTreeState* state) {
    a.integer<std::uint32_t>("modal tree", tree, 0, static_cast<std::uint32_t>(trees) - 1);
    a.integer<std::uint32_t>("modes", modes, 1, static_cast<std::uint32_t>(FINE_MODES.most()));
    if (state) return state->archive(a);
    if (!modal_states_.empty() && tree <= modal_states_.rbegin()->first)
      Archive::rejectOrder("modal trees", modal_states_.size());
    ModalTreeState read = modes_of(tree, modes);
    read.archive(a);
    modal_states_.emplace_hint(modal_states_.end(), tree, std::move(read));
  };
  if (!a.reads()) {
    for (auto& [tree, state] : modal_states_)
      each(tree, static_cast<std::uint32_t>(state.modes().size()), &state);
    return;
  }
  clear();
  for (std::size_t i = 0; i < count; ++i) each(0, 0, nullptr);
}

}  // namespace vegetation_sim::forest
