// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/forest_modes.h"

#include <algorithm>

#include "vegetation_sim/forest/procedural_motion.h"

namespace vegetation_sim::forest {
namespace {

constexpr double QUICK = 30.0;  // [rad/s]

std::size_t stepsBetween(Nanoseconds from, Nanoseconds to) {
  const Nanoseconds steps =
      ((to - from) * ForestModes::RATE + NANOSECONDS_PER_SECOND / 2) / NANOSECONDS_PER_SECOND;
  return static_cast<std::size_t>(std::max<Nanoseconds>(1, steps));
}

// Of a tree of few branches plain modes would be nearly all: it has all.
Sway swayOf(const Grounds& at, std::uint32_t id, bool fine) {
  const Tree tree = growTree(at.layout, id, at.terrain);
  const bool few = 2 * tree.skeleton.branches.size() <= ModalDepth{}.most();
  return Sway(std::make_shared<const ModalTree>(tree, at.layout.species[tree.seed.species],
                                                fine || few ? FINE_MODES : ModalDepth{}));
}

}  // namespace

void ForestModes::advance(const wind::Field& wind, Nanoseconds from, Nanoseconds to) {
  if (sways_.empty()) return;
  if (to <= from || to - from > LONGEST_GAP) {
    for (auto& entry : sways_) start(wind, entry.second, to);
    return;
  }
  const std::size_t steps = stepsBetween(from, to);
  instants_.resize(steps + 1);
  for (std::size_t i = 0; i <= steps; ++i)
    wind.at(from + (to - from) * static_cast<Nanoseconds>(i) / static_cast<Nanoseconds>(steps),
            instants_[i]);
  loads_.resize(steps + 1);
  for (auto& [tree, sway] : sways_) {
    for (std::size_t i = 0; i <= steps; ++i) sway.loadOf(instants_[i], loads_[i]);
    sway.step(loads_, to);
  }
}

void ForestModes::start(const wind::Field& wind, Sway& sway, Nanoseconds stamp) {
  std::array<std::vector<double>, 3> loads;
  WindWindow window;
  window.lookAt(wind, stamp);
  for (std::size_t look = 0; look < loads.size(); ++look)
    sway.loadOf(window.looks()[look], loads[look]);
  sway.begin(loads, secondsBetween(0, LOOK), stamp);
}

void ForestModes::begin(const Grounds& at, std::uint32_t tree, bool fine, Nanoseconds stamp) {
  const auto found = sways_.find(tree);
  if (found == sways_.end())
    start(at.wind, sways_.emplace(tree, swayOf(at, tree, fine)).first->second, stamp);
  else if (fine && !found->second.fine())
    refine(at, tree, found->second);
}

// Nothing jumps: the same bends, and the same rates, told by more oscillators. Those that are too
// fast for a tick begin as the load holds them: left to ring they would jerk.
void ForestModes::refine(const Grounds& at, std::uint32_t tree, Sway& sway) {
  Sway fine = swayOf(at, tree, true);
  const auto told = [&](const std::vector<double>& amplitudes) {
    return fine.modes().amplitudesOf(sway.modes().bendsOf(amplitudes));
  };
  std::vector<double> load;
  fine.loadOf(at.wind.at(sway.stamp()), load);
  physics::ModalState state{told(sway.state().amplitude), told(sway.state().rate)};
  for (std::size_t m = 0; m < load.size(); ++m) {
    const double frequency = fine.modes().modes().frequency[m];
    if (frequency < QUICK) continue;
    state.amplitude[m] = load[m] / (frequency * frequency);
    state.rate[m] = 0.0;
  }
  fine.restore(state, load, sway.stamp());
  sway = std::move(fine);
}

// Their number tells which modes they are.
void ForestModes::restore(const Grounds& at, std::uint32_t tree, const physics::ModalState& state,
                          Nanoseconds stamp) {
  const std::size_t count = state.amplitude.size();
  const auto found = sways_.find(tree);
  const bool known = found != sways_.end() && found->second.modes().size() == count;
  const bool fine = count > ModalDepth{}.most();
  Sway& sway =
      known ? found->second : sways_.insert_or_assign(tree, swayOf(at, tree, fine)).first->second;
  std::vector<double> load;
  sway.loadOf(at.wind.at(stamp), load);
  sway.restore(state, load, stamp);
}

void ForestModes::settle(const LevelMap& levels, Nanoseconds stamp, double transition) {
  for (auto it = sways_.begin(); it != sways_.end();) {
    const LevelState level = levels.of(it->first);
    const bool over =
        level.level < MODAL_LEVEL && modalWeight(blendAt(level, stamp, transition)) <= 0.0;
    it = over ? sways_.erase(it) : std::next(it);
  }
}

void ForestModes::keepOnly(const std::set<std::uint32_t>& trees) {
  for (auto it = sways_.begin(); it != sways_.end();)
    it = trees.count(it->first) ? std::next(it) : sways_.erase(it);
}

const Sway* ForestModes::find(std::uint32_t tree) const {
  const auto found = sways_.find(tree);
  return found == sways_.end() ? nullptr : &found->second;
}

std::size_t ForestModes::bytes() const {
  std::size_t out = 0;
  for (const auto& entry : sways_) out += entry.second.bytes();
  return out;
}

std::size_t ForestModes::strained() const {
  return static_cast<std::size_t>(std::count_if(
      sways_.begin(), sways_.end(),
      [](const auto& entry) { return !entry.second.modes().probe().holds(entry.second.state()); }));
}

void ForestModes::addTo(Hash& hash) const {
  for (const auto& [tree, sway] : sways_) {
    hash.add(static_cast<std::uint64_t>(tree));
    for (const double a : sway.state().amplitude) hash.add(a);
    for (const double r : sway.state().rate) hash.add(r);
  }
}

}  // namespace vegetation_sim::forest
