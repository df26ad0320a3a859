// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/forest_replica.h"

namespace vegetation_sim::forest {
namespace {

// Branches of trees that are counted to check one message, about 20 ms; further trees wait for the
// next key frame.
constexpr std::size_t MOST_COUNTED = 262144;
constexpr std::size_t MOST_COUNTS = 65536;  // branch counts that are kept
constexpr std::size_t MOST_AT_ONCE = 64;    // trees whose fine modes one message computes

}  // namespace

void ForestReplica::setLayout(Layout layout, std::shared_ptr<const terrain::HeightMap> terrain) {
  Faults faults;
  check(layout, faults);
  if (layout.terrain_hash != terrain->hash())
    faults.add("layout: terrain = '" + layout.terrain + "' has other heights here than where it " +
               "was made");
  faults.throwIfAny();
  layout_hash_ = layout.hash();
  layout_ = std::make_shared<const Layout>(std::move(layout));
  terrain_ = std::move(terrain);
  promoted_.clear();  // its branches may be missing in the new trees
  branch_counts_.clear();
  broken_.clear();
  modes_.clear();
  in_sequence_ = false;
  why_ = "no key frame since the layout";
}

void ForestReplica::forgetState() {
  levels_.reset({});
  promoted_.clear();
  broken_.clear();
  modes_.clear();
  in_sequence_ = false;
  stamp_ = 0;
  why_ = "time went back";
}

bool ForestReplica::apply(const StateUpdate& update) {
  if (!ready()) {
    why_ = "no layout yet";
    return false;
  }
  if (update.layout_hash != layout_hash_) {
    why_ = "state belongs to another layout";
    in_sequence_ = false;
    return false;
  }
  if (!update.key_frame && !(in_sequence_ && update.sequence == sequence_ + 1)) {
    if (in_sequence_) why_ = "messages were lost";
    in_sequence_ = false;
    return false;
  }
  if (!fitsLayout(update)) {
    why_ = "the branches of its physical and broken trees are being counted";
    in_sequence_ = false;
    return false;
  }
  if (update.key_frame)
    levels_.reset(update.base);
  else
    levels_.setBase(update.base);
  if (update.key_frame) promoted_.clear();
  updateBroken(update);
  for (const StateUpdate::Entry& entry : update.trees) {
    if (entry.state == update.base)
      levels_.resetToBase(entry.tree);  // listed for its physical joints
    else
      levels_.set(entry.tree, entry.state);
    if (entry.promoted.empty())
      promoted_.erase(entry.tree);
    else
      promoted_[entry.tree] = entry.promoted;
  }
  blend_ = update.blend;
  levels_.prune(update.stamp, layout_->motion.transition);
  in_sequence_ = updateModes(update);
  sequence_ = update.sequence;
  stamp_ = update.stamp;
  if (in_sequence_) why_.clear();
  return in_sequence_;
}

// Returns false if there are too many unknown trees for one message; the next one finds them known.
bool ForestReplica::fitsLayout(const StateUpdate& update) {
  Faults faults;
  const std::uint32_t trees = layout_->treeCount();
  if (branch_counts_.size() > MOST_COUNTS) branch_counts_.clear();
  std::size_t counted = 0;
  for (const StateUpdate::Entry& entry : update.trees) {
    const std::string name = "state: tree " + std::to_string(entry.tree);
    if (entry.tree >= trees) {
      faults.add(name + " is not below the " + std::to_string(trees) + " trees of the layout");
      continue;
    }
    if (entry.promoted.empty() && entry.broken.empty()) continue;
    auto count = branch_counts_.find(entry.tree);
    if (count == branch_counts_.end()) {
      if (counted > MOST_COUNTED) return false;
      const TreeSeed seed = seedOf(*layout_, entry.tree);
      count =
          branch_counts_.emplace(entry.tree, countBranches(seed, layout_->species.at(seed.species)))
              .first;
      counted += count->second;
    }
    const auto check_branch = [&, branches = count->second](int branch) {
      if (static_cast<std::size_t>(branch) >= branches)
        faults.add(name + ": branch " + std::to_string(branch) + " is not below its " +
                   std::to_string(branches) + " branches");
    };
    if (!entry.promoted.empty()) check_branch(entry.promoted.back().branch);
    for (const BrokenBranch& broken : entry.broken) {
      check_branch(broken.branch);
      if (broken.branch < 1) faults.add(name + ": its foot cannot come off");
    }
  }
  faults.throwIfAny();
  return true;
}

// A tree that has lost branches has other modes from then on.
void ForestReplica::updateBroken(const StateUpdate& update) {
  BrokenTrees now;
  if (!update.key_frame) now = broken_;
  for (const StateUpdate::Entry& entry : update.trees) {
    if (entry.broken.empty())
      now.erase(entry.tree);
    else
      now[entry.tree] = entry.broken;
  }
  for (const BrokenTrees* trees : {&broken_, &now})
    for (const auto& entry : *trees)
      if (!(brokenOf(broken_, entry.first) == brokenOf(now, entry.first)))
        modes_.removeTree(entry.first);
  broken_ = std::move(now);
}

// Between key frames modes are stepped as in the forest.
bool ForestReplica::updateModes(const StateUpdate& update) {
  std::set<std::uint32_t> published;
  for (const StateUpdate::Entry& entry : update.trees)
    if (!entry.modal.amplitude.empty()) published.insert(entry.tree);
  if (update.key_frame)
    modes_.retain(published);
  else
    modes_.advance(wind_, stamp_, update.stamp);
  try {
    restoreModes(update);
  } catch (const std::exception& error) {
    why_ = "tree in modes: " + std::string(error.what());
    return false;
  }
  modes_.removeFaded(levels_, update.stamp, layout_->motion.transition);
  return true;
}

void ForestReplica::restoreModes(const StateUpdate& update) {
  const ModalContext at{*layout_, *terrain_, wind_, &broken_};
  std::size_t at_once = fine_modes_ == FineModes::AT_ONCE ? MOST_AT_ONCE : 0;
  bool due = update.key_frame || ModalForest::fineDue(stamp_, update.stamp);
  for (const StateUpdate::Entry& entry : update.trees) {
    const std::size_t modes = entry.modal.amplitude.size();
    if (modes == 0) continue;
    const bool ready = modes_.isReady(entry.tree, modes);
    if (ready || at_once > 0 || due)
      modes_.restore(at, entry.tree, entry.modal, update.stamp);
    else
      modes_.queueFineModes(entry.tree);
    if (ready) continue;
    if (at_once > 0)
      --at_once;
    else
      due = false;
  }
  if (due) modes_.prepareNext(at);  // used from the next key frame on
}

std::vector<Pose> ForestReplica::pose(const Tree& tree, std::uint32_t id, Nanoseconds stamp) const {
  return poseBranches(tree, wind_.at(stamp).relativeTo(tree.foot), weights(id, stamp),
                      modalState(id), promoted(id), stamp);
}

PromotedTree ForestReplica::promoted(std::uint32_t tree) const {
  const auto found = promoted_.find(tree);
  if (found == promoted_.end()) return {stamp_, blend_, {}};
  return {stamp_, blend_, found->second};
}

std::vector<std::uint32_t> ForestReplica::physicalTrees() const {
  std::vector<std::uint32_t> out;
  for (const auto& entry : promoted_) out.push_back(entry.first);
  return out;
}

}  // namespace vegetation_sim::forest
