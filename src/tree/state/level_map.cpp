// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/state/level_map.h"

#include "tree/state/tree_hashes.h"

namespace vegetation_sim::forest {
namespace {

void addLevel(Hash& hash, const LevelState& state, Nanoseconds stamp, double transition) {
  hash.add(static_cast<std::uint64_t>(state.level));
  for (const double alpha : blendAt(state, stamp, transition)) hash.add(alpha);
}

}  // namespace

LevelState LevelMap::of(std::uint32_t tree) const {
  const auto found = held_.find(tree);
  return found == held_.end() ? base_ : found->second;
}

std::array<std::size_t, MODAL_LEVEL + 1> LevelMap::counts(std::size_t trees) const {
  std::array<std::size_t, MODAL_LEVEL + 1> out{};
  out[static_cast<std::size_t>(base_.level)] = trees - held_.size();
  for (const auto& entry : held_) ++out[static_cast<std::size_t>(entry.second.level)];
  return out;
}

void LevelMap::reset(const LevelState& base) {
  base_ = base;
  held_.clear();
}

void LevelMap::changeBase(int level, Nanoseconds stamp, double transition) {
  if (level != base_.level) setLevel(base_, level, stamp, transition);
}

void LevelMap::anchor(Nanoseconds stamp, double transition) {
  setLevel(base_, base_.level, stamp, transition);
  for (auto& entry : held_) setLevel(entry.second, entry.second.level, stamp, transition);
}

void LevelMap::prune(Nanoseconds stamp, double transition) {
  const bool base_settled = isSettled(base_, stamp, transition);
  if (base_settled) base_ = LevelState::settled(base_.level);
  for (auto it = held_.begin(); it != held_.end();) {
    LevelState& state = it->second;
    const bool settled = isSettled(state, stamp, transition);
    if (settled) state = LevelState::settled(state.level);  // says the same in fewer bytes
    it = settled && base_settled && state.level == base_.level ? held_.erase(it) : std::next(it);
  }
}

bool LevelMap::isAtBase(const LevelState& state, Nanoseconds stamp, double transition) const {
  return state.level == base_.level && isSettled(base_, stamp, transition) &&
         isSettled(state, stamp, transition);
}

void LevelMap::addTo(Hash& hash, Nanoseconds stamp, double transition) const {
  addLevel(hash, base_, stamp, transition);
  for (const auto& [tree, state] : held_) {
    if (isAtBase(state, stamp, transition)) continue;
    hash.add(static_cast<std::uint64_t>(tree));
    addLevel(hash, state, stamp, transition);
  }
}

void LevelMap::addTo(TreeHashes& hashes, Nanoseconds stamp, double transition) const {
  for (const auto& [tree, state] : held_)
    if (!isAtBase(state, stamp, transition))
      addLevel(hashes.of(tree, TreeHashes::LEVEL), state, stamp, transition);
}

}  // namespace vegetation_sim::forest
