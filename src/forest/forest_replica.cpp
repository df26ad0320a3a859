// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/forest_replica.h"

#include <algorithm>

#include "tree/shards/tree_owners.h"

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
    faults.add("layout: terrain = " + inQuotes(layout.terrain, LONGEST_ADDRESS) +
               " has other heights here than where it " + "was made");
  faults.throwIfAny();
  layout_hash_ = layout.hash();
  layout_ = std::make_shared<const Layout>(std::move(layout));
  terrain_ = std::move(terrain);
  parts_.resize(1);
  parts_.front().promoted.clear();  // its branches may be missing in the new trees
  parts_.front().modes.clear();
  parts_.front().in_sequence = false;
  branch_counts_.clear();
  broken_.clear();
  why_ = "no key frame since the layout";
}

void ForestReplica::forgetState() {
  parts_.assign(1, Part());
  broken_.clear();
  why_ = "time went back";
}

std::size_t ForestReplica::shardOf(std::uint32_t tree) const {
  return owners_->ownerOf(tree);
}

bool ForestReplica::apply(const StateUpdate& update) {
  if (!ready()) {
    why_ = "no layout yet";
    return false;
  }
  if (update.layout_hash != layout_hash_) {
    why_ = "state belongs to another layout";
    if (std::max<std::uint32_t>(1, update.shards) == shards() && update.shard < parts_.size())
      parts_[update.shard].in_sequence = false;
    return false;
  }
  Part& part = choosePart(update);
  if (!update.key_frame && !(part.in_sequence && update.sequence == part.sequence + 1)) {
    if (part.in_sequence) why_ = "messages were lost";
    part.in_sequence = false;
    return false;
  }
  if (!fitsLayout(update)) {
    why_ = "the branches of its physical and broken trees are being counted";
    part.in_sequence = false;
    return false;
  }
  if (update.key_frame)
    part.levels.reset(update.base);
  else
    part.levels.setBase(update.base);
  if (update.key_frame) part.promoted.clear();
  updateBroken(update, part);
  for (const StateUpdate::Entry& entry : update.trees) {
    if (entry.state == update.base)
      part.levels.resetToBase(entry.tree);  // listed for its physical joints
    else
      part.levels.set(entry.tree, entry.state);
    if (entry.promoted.empty())
      part.promoted.erase(entry.tree);
    else
      part.promoted[entry.tree] = entry.promoted;
  }
  part.blend = update.blend;
  part.levels.prune(update.stamp, layout_->motion.transition);
  part.in_sequence = updateModes(update, part);
  part.sequence = update.sequence;
  part.stamp = update.stamp;
  if (part.in_sequence) why_.clear();
  return part.in_sequence;
}

// Returns the part of the shard of a message. The number of shards is fixed while one is in step
// and heard: a landscape that is started again with another number is followed once the old one is
// silent.
ForestReplica::Part& ForestReplica::choosePart(const StateUpdate& update) {
  const Shard shard{update.shard, std::max<std::uint32_t>(1, update.shards)};
  Faults faults;
  check(shard, faults);
  const bool is_fixed = std::any_of(parts_.begin(), parts_.end(), [&](const Part& part) {
    return part.in_sequence && !isSilentShard(part.stamp, update.stamp);
  });
  if (is_fixed && shard.count != shards())
    faults.add("state: shards = " + std::to_string(shard.count) + ", but other messages have " +
               std::to_string(shards()));
  faults.throwIfAny();
  if (shard.count != shards()) {
    owners_ = std::make_shared<const TreeOwners>(*layout_, shard);
    parts_.assign(shard.count, Part());
  }
  return parts_[shard.index];
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
    if (parts_.size() > 1 && shardOf(entry.tree) != update.shard)
      faults.add(name + " belongs to shard " + std::to_string(shardOf(entry.tree)) +
                 ", but the message is of shard " + std::to_string(update.shard));
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
void ForestReplica::updateBroken(const StateUpdate& update, Part& part) {
  BrokenTrees now;
  for (const auto& entry : broken_)
    if (!update.key_frame || &partOf(entry.first) != &part) now.insert(now.end(), entry);
  for (const StateUpdate::Entry& entry : update.trees) {
    if (entry.broken.empty())
      now.erase(entry.tree);
    else
      now[entry.tree] = entry.broken;
  }
  for (const BrokenTrees* trees : {&broken_, &now})
    for (const auto& entry : *trees)
      if (!(brokenOf(broken_, entry.first) == brokenOf(now, entry.first)))
        part.modes.removeTree(entry.first);
  broken_ = std::move(now);
}

// Between key frames modes are stepped as in the forest.
bool ForestReplica::updateModes(const StateUpdate& update, Part& part) {
  std::set<std::uint32_t> published;
  for (const StateUpdate::Entry& entry : update.trees)
    if (!entry.modal.amplitude.empty()) published.insert(entry.tree);
  if (update.key_frame)
    part.modes.retain(published);
  else
    part.modes.advance(wind_, part.stamp, update.stamp);
  try {
    restoreModes(update, part);
  } catch (const std::exception& error) {
    why_ = "tree in modes: " + std::string(error.what());
    return false;
  }
  part.modes.removeFaded(part.levels, update.stamp, layout_->motion.transition);
  return true;
}

void ForestReplica::restoreModes(const StateUpdate& update, Part& part) {
  const ModalContext at{*layout_, *terrain_, wind_, &broken_};
  std::size_t at_once = fine_modes_ == FineModes::AT_ONCE ? MOST_AT_ONCE : 0;
  bool due = update.key_frame || ModalForest::fineDue(part.stamp, update.stamp);
  for (const StateUpdate::Entry& entry : update.trees) {
    const std::size_t modes = entry.modal.amplitude.size();
    if (modes == 0) continue;
    const bool ready = part.modes.isReady(entry.tree, modes);
    if (ready || at_once > 0 || due)
      part.modes.restore(at, entry.tree, entry.modal, update.stamp);
    else
      part.modes.queueFineModes(entry.tree);
    if (ready) continue;
    if (at_once > 0)
      --at_once;
    else
      due = false;
  }
  if (due) part.modes.prepareNext(at);  // used from the next key frame on
}

std::vector<Pose> ForestReplica::pose(const Tree& tree, std::uint32_t id, Nanoseconds stamp) const {
  return poseBranches(tree, wind_.at(stamp).relativeTo(tree.foot), weights(id, stamp),
                      modalState(id), promoted(id), stamp);
}

PromotedTree ForestReplica::promoted(std::uint32_t tree) const {
  const Part& part = partOf(tree);
  const auto found = part.promoted.find(tree);
  if (found == part.promoted.end()) return {part.stamp, part.blend, {}};
  return {part.stamp, part.blend, found->second};
}

std::vector<std::uint32_t> ForestReplica::physicalTrees() const {
  std::vector<std::uint32_t> out;
  for (const Part& part : parts_)
    for (const auto& entry : part.promoted) out.push_back(entry.first);
  std::sort(out.begin(), out.end());
  return out;
}

Nanoseconds ForestReplica::stamp() const {
  Nanoseconds out = parts_.front().stamp;
  for (const Part& part : parts_) out = std::min(out, part.stamp);
  return out;
}

}  // namespace vegetation_sim::forest
