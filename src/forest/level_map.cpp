// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/level_map.h"

namespace vegetation_sim::forest {

LevelState LevelMap::of(std::uint32_t tree) const {
  const auto found = held_.find(tree);
  return found == held_.end() ? LevelState::settled(base_) : found->second;
}

void LevelMap::reset(int base) {
  base_ = base;
  held_.clear();
}

void LevelMap::rebase(int base, std::uint32_t count) {
  if (base == base_) return;
  const LevelState resting = LevelState::settled(base_);
  for (std::uint32_t tree = 0; tree < count; ++tree) held_.emplace(tree, resting);
  base_ = base;
}

bool LevelMap::resting(const LevelState& state, Nanoseconds stamp, double transition) const {
  return state.level == base_ && isSettled(state, stamp, transition);
}

void LevelMap::prune(Nanoseconds stamp, double transition) {
  for (auto it = held_.begin(); it != held_.end();)
    it = resting(it->second, stamp, transition) ? held_.erase(it) : std::next(it);
}

void LevelMap::addTo(Hash& hash, Nanoseconds stamp, double transition) const {
  hash.add(static_cast<std::uint64_t>(base_));
  for (const auto& [tree, state] : held_) {
    if (resting(state, stamp, transition)) continue;
    hash.add(static_cast<std::uint64_t>(tree));
    hash.add(static_cast<std::uint64_t>(state.level));
    for (const double alpha : blendAt(state, stamp, transition)) hash.add(alpha);
  }
}

}  // namespace vegetation_sim::forest
