// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/detail/tree_detail.h"

namespace vegetation_sim::forest {

void TreeDetail::reset(int level) {
  levels.reset(LevelState::settled(level));
  modes.clear();
  request.reset();
  forgetChanges();
  sequence = 0;
}

void TreeDetail::forgetChanges() {
  changed.clear();
  begun.clear();
}

void TreeDetail::setLevel(std::uint32_t tree, int level, Nanoseconds stamp, double transition) {
  LevelState state = levels.of(tree);
  if (state.level == level) return;
  forest::setLevel(state, level, stamp, transition);
  levels.set(tree, state);
  changed.insert(tree);
}

void TreeDetail::prune(Nanoseconds stamp, double transition) {
  levels.prune(stamp, transition);
  modes.removeFaded(levels, stamp, transition);
}

const ModalTreeState* TreeDetail::loseBranches(const ModalContext* at, std::uint32_t tree,
                                               const ModalTreeState* like) {
  changed.insert(tree);
  begun.erase(tree);
  if (request && request->tree == tree) request.reset();
  const ModalTreeState* out = at ? modes.replaceModes(*at, tree, like) : nullptr;
  if (out)
    begun.insert(tree);
  else
    modes.removeTree(tree);
  return out;
}

void TreeDetail::addTo(StateUpdate& update, const std::vector<std::uint32_t>& physical,
                       const BrokenTrees& broken,
                       const std::function<PromotedTree(std::uint32_t tree)>& promoted) {
  update.sequence = sequence++;
  update.base = levels.base();
  std::set<std::uint32_t> published;
  if (update.key_frame) {
    for (const auto& entry : levels.held()) published.insert(entry.first);
    for (const auto& entry : broken) published.insert(entry.first);
  } else {
    published = changed;
  }
  published.insert(physical.begin(), physical.end());
  for (const std::uint32_t tree : published) {
    const ModalTreeState* state = modes.find(tree);
    const bool amplitudes = state && (update.key_frame || begun.count(tree));
    update.trees.push_back({tree, levels.of(tree), promoted(tree).branches,
                            amplitudes ? state->state() : physics::ModalState(),
                            brokenOf(broken, tree)});
  }
  forgetChanges();
}

}  // namespace vegetation_sim::forest
