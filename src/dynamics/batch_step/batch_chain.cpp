// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/batch_step/batch_chain.h"

#include <algorithm>
#include <cmath>

#include "dynamics/batch_step/chain_sweep.h"
#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim::physics {
namespace {

// Trees step together up to this many links, so that the second-level cache holds them.
constexpr std::size_t GROUP_LINKS = 2048;

}  // namespace

BatchChain::BatchChain(BatchChain&&) noexcept = default;
BatchChain& BatchChain::operator=(BatchChain&&) noexcept = default;
BatchChain::~BatchChain() = default;

BatchChain::BatchChain(const std::vector<Link>& tree)
    : BatchChain(std::vector<std::vector<Link>>{tree}) {}

// Trees that consist of bars take a shorter path. They do not share groups with others, so that the
// bits of a tree do not depend on the other trees.
BatchChain::BatchChain(const std::vector<std::vector<Link>>& trees)
    : store_(std::make_unique<ChainStore>()), trees_(trees.size()) {
  for (const bool bars : {true, false}) {
    bool open = false;
    std::size_t links = 0;
    for (std::size_t t = 0; t < trees.size(); ++t) {
      if (std::all_of(trees[t].begin(), trees[t].end(), isBar) != bars) continue;
      if (!open || links + trees[t].size() > GROUP_LINKS) {
        groups_.emplace_back();
        groups_.back().bars = groups_.back().on_axis = bars;
        links = 0;
        open = true;
      }
      links += trees[t].size();
      groups_.back().trees.push_back(t);
    }
  }
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    sortGroup(trees, g);
    for (const Level& level : groups_[g].levels) widest_ = std::max(widest_, level.count);
  }
  fill(trees);
}

void BatchChain::sortGroup(const std::vector<std::vector<Link>>& trees, std::size_t index) {
  ChainGroup& group = groups_[index];
  std::vector<int> parents;
  for (const std::size_t t : group.trees) {
    Member& member = trees_[t];
    const int offset = static_cast<int>(parents.size());
    member.group = index;
    member.first = slots_.size() + parents.size();
    member.count = trees[t].size();
    for (std::size_t i = 0; i < trees[t].size(); ++i) {
      const Link& link = trees[t][i];
      const bool root = link.parent < 0;
      parents.push_back(root ? -1 : link.parent + offset);
      member.base.push_back(root ? link.base : member.base[static_cast<std::size_t>(link.parent)]);
      if (root) member.roots.push_back(static_cast<int>(i));
    }
  }
  group.begin = slot_count_;
  group.end = slot_count_ = sortIntoLevels(parents, slot_count_, group.levels, slots_);
  sortBySlot(group);
  group.bases.resize(group.levels.empty() ? 0 : static_cast<std::size_t>(group.levels[0].count));
}

// Lists each member's links in the order of their slots.
void BatchChain::sortBySlot(const ChainGroup& group) {
  constexpr std::size_t NO_TREE = ~std::size_t{0};
  struct Owner {
    std::size_t tree{NO_TREE}, link{0};
  };
  std::vector<Owner> owners(static_cast<std::size_t>(group.end - group.begin));
  for (const std::size_t t : group.trees)
    for (std::size_t i = 0; i < trees_[t].count; ++i)
      owners[static_cast<std::size_t>(slots_[trees_[t].first + i] - group.begin)] = {t, i};
  for (const std::size_t t : group.trees) trees_[t].by_slot.reserve(trees_[t].count);
  for (const Owner& owner : owners)
    if (owner.tree != NO_TREE) trees_[owner.tree].by_slot.push_back(owner.link);
}

std::size_t BatchChain::blocks() const {
  return static_cast<std::size_t>(slot_count_ / ROW);
}

void BatchChain::fill(const std::vector<std::vector<Link>>& trees) {
  ChainStore& store = *store_;
  const bool bars = std::all_of(groups_.begin(), groups_.end(),
                                [](const ChainGroup& group) { return group.bars; });
  store.constant_rows = bars ? C_BAR_ROWS : C_ROWS;
  store.constants.assign(blocks() * static_cast<std::size_t>(store.constant_rows));
  store.state.assign(blocks() * S_ROWS);
  for (const ChainGroup& group : groups_) largest_ = std::max(largest_, group.end - group.begin);
  for (int slot = 0; slot < slot_count_; ++slot) {
    fillEmptyLane(store.constant_rows, store.constants.of(slot, store.constant_rows));
    store.state.of(slot, S_ROWS)[S_THETA * ROW] = 0.5f;
    store.state.of(slot, S_ROWS)[S_PRODUCTS * ROW] = 1.f;
  }
  for (std::size_t t = 0; t < trees.size(); ++t) {
    for (std::size_t i = 0; i < trees[t].size(); ++i)
      fillLink(trees[t][i], store.constant_rows,
               store.constants.of(slots_[trees_[t].first + i], store.constant_rows));
    fillBases(trees_[t]);
  }
}

// ---- state -------------------------------------------------------------------------------------

void BatchChain::setState(int tree, const ChainState& state, double theta) {
  Member& member = this->member(tree);
  for (std::size_t i = 0; i < member.count; ++i) {
    float* rows = store_->state.of(slots_[member.first + i], S_ROWS);
    for (int axis = 0; axis < 2; ++axis) {
      rows[(S_Q + axis) * ROW] = static_cast<float>(state.q[i][axis]);
      rows[(S_RATE + axis) * ROW] = static_cast<float>(state.rate[i][axis]);
    }
  }
  setTheta(member, theta, member.products);
  groups_[member.group].calm = groups_[member.group].stepped = false;  // the guard checks itself
}

void BatchChain::setScratch(ChainScratch& scratch) {
  store_->scratch = &scratch;
  own_scratch_.reset();
}

void BatchChain::prepareScratch() {
  if (!store_->scratch) {
    own_scratch_ = std::make_unique<ChainScratch>();
    store_->scratch = own_scratch_.get();
  }
  store_->scratch->fit(static_cast<std::size_t>(largest_ / ROW), widest_);
}

void BatchChain::setProducts(Products products) {
  store_->averages = products == Products::MEAN;
}

ChainState BatchChain::state(int tree) const {
  ChainState out;
  readState(tree, out);
  return out;
}

void BatchChain::readState(int tree, ChainState& out) const {
  const Member& member = trees_[static_cast<std::size_t>(tree)];
  out.q.resize(member.count);
  out.rate.resize(member.count);
  for (std::size_t i = 0; i < member.count; ++i) {
    const float* rows = store_->state.of(slots_[member.first + i], S_ROWS);
    out.q[i] = Vec2(rows[S_Q * ROW], rows[(S_Q + 1) * ROW]);
    out.rate[i] = Vec2(rows[S_RATE * ROW], rows[(S_RATE + 1) * ROW]);
  }
}

Vec2 BatchChain::bend(int tree, std::size_t link) const {
  const Member& member = trees_[static_cast<std::size_t>(tree)];
  const float* rows = store_->state.of(slots_[member.first + link], S_ROWS);
  return {rows[S_Q * ROW], rows[(S_Q + 1) * ROW]};
}

// Comparisons with NaN are false, so it is counted as beyond.
bool BatchChain::isWithin(double bend, double rate) const {
  constexpr double ROUNDING = 1.0 - 1e-6;
  const float most_bend = static_cast<float>(ROUNDING * bend * bend),
              most_rate = static_cast<float>(ROUNDING * rate * rate);
  int within = 0;
  for (std::size_t block = 0; block < blocks(); ++block) {
    const float* rows = store_->state.at(block * S_ROWS);
    for (int lane = 0; lane < ROW; ++lane) {
      const float x = rows[S_Q * ROW + lane], y = rows[(S_Q + 1) * ROW + lane];
      const float u = rows[S_RATE * ROW + lane], v = rows[(S_RATE + 1) * ROW + lane];
      within += static_cast<int>(x * x + y * y <= most_bend) &
                static_cast<int>(u * u + v * v <= most_rate);
    }
  }
  return within == slot_count_;
}

std::size_t BatchChain::bytes() const {
  const ChainStore& s = *store_;
  std::size_t out = s.constants.bytes() + s.state.bytes() + s.loads.bytes() + s.grips.bytes() +
                    s.air.bytes() + s.beside.bytes() + slots_.capacity() * sizeof(int);
  if (own_scratch_) out += own_scratch_->bytes();
  for (const ChainGroup& group : groups_)
    for (const Level& level : group.levels)
      for (const ChildRank& child_rank : level.child_ranks)
        out += child_rank.first.capacity() * sizeof(std::int32_t);
  return out;
}

// ---- guard -------------------------------------------------------------------------------------

double BatchChain::fastestOf(const Member& member) const {
  const ChainGroup& group = groups_[member.group];
  if (group.stepped && group.trees.size() == 1) return group.fastest;
  float out = 0.f;
  for (std::size_t i = 0; i < member.count; ++i) {
    const float* rows = store_->state.of(slots_[member.first + i], S_ROWS);
    for (int axis = 0; axis < 2; ++axis)
      out = std::max(out, std::fabs(rows[(S_RATE + axis) * ROW]));
  }
  return out;
}

void BatchChain::setTheta(Member& member, double theta, double products) {
  if (theta == member.theta && products == member.products) return;
  member.theta = theta;
  member.products = products;
  for (std::size_t i = 0; i < member.count; ++i) {
    float* rows = store_->state.of(slots_[member.first + i], S_ROWS);
    rows[S_THETA * ROW] = static_cast<float>(theta);
    rows[S_PRODUCTS * ROW] = static_cast<float>(products);
  }
}

// Trees are checked one by one only where one of them may be fast, or was.
void BatchChain::guard(ChainGroup& group, double h) {
  if (group.calm && thetaFor(group.fastest, h, 0.5) == 0.5) return;
  group.calm = true;
  for (const std::size_t t : group.trees) {
    const double fastest = fastestOf(trees_[t]);
    setTheta(trees_[t], thetaFor(fastest, h, trees_[t].theta), productsFor(fastest, h));
    group.calm = group.calm && trees_[t].theta == 0.5 && trees_[t].products == 1.0;
  }
}

// ---- steps -------------------------------------------------------------------------------------

void BatchChain::stepGroup(ChainGroup& group, const Surroundings* around, double time, double h,
                           int number) {
  store_->mean = store_->averages && number == 0;
  store_->predicted = store_->averages && number > 0;
  const auto step = static_cast<float>(h);
  const auto at = [&](std::size_t t) { return time + trees_[t].theta * h; };
  guard(group, h);
  if (around)
    for (const std::size_t t : group.trees) updateBases(around[t], at(t), trees_[t]);
  sweepOut(group, step, *store_);
  if (store_->asked) queryWindOf(group);
  store_->anchors.clear();
  if (around)
    for (const std::size_t t : group.trees) updateLoads(around[t], at(t), h, trees_[t]);
  std::stable_sort(store_->anchors.begin(), store_->anchors.end(),
                   [](const AnchorRows& a, const AnchorRows& b) { return a.slot < b.slot; });
  group.fastest = sweepBack(group, step, *store_);
  group.stepped = true;
}

void BatchChain::stepWithin(const Surroundings* around, std::size_t count, double time, double h,
                            int number) {
  if (count != trees_.size())
    throw InvalidInput("surroundings: " + std::to_string(count) + "; one for each of the " +
                       std::to_string(trees_.size()) + " trees");
  store_->trace = std::any_of(around, around + count,
                              [](const Surroundings& s) { return static_cast<bool>(s.loads); });
  prepareScratch();
  store_->asked = query_ && !store_->grips.empty();
  for (ChainGroup& group : groups_)
    if (!group.levels.empty()) stepGroup(group, around, time, h, number);
  query_ = nullptr;
  loaded_ = nullptr;
}

void BatchChain::step(const std::vector<Surroundings>& around, double time, double h, int number) {
  stepWithin(around.data(), around.size(), time, h, number);
}

void BatchChain::step(const Surroundings& around, double time, double h, int number) {
  stepWithin(&around, 1, time, h, number);
}

// All steps of one group run before those of the next, because the caches hold one group.
void BatchChain::step(double h, int steps) {
  store_->trace = false;
  prepareScratch();
  for (ChainGroup& group : groups_) {
    if (group.levels.empty()) continue;
    store_->asked = query_ && !store_->grips.empty();
    for (int i = 0; i < steps; ++i) {
      stepGroup(group, nullptr, 0.0, h, i);
      store_->asked = false;
    }
  }
  query_ = nullptr;
}

}  // namespace vegetation_sim::physics
