// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Loads on the links of a BatchChain: bases, loads, air.
#include <algorithm>

#include "dynamics/batch_step/batch_chain.h"
#include "dynamics/batch_step/chain_sweep.h"
#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim::physics {

void BatchChain::updateBases(const Surroundings& around, double time, Member& member) {
  member.bases.clear();
  if (around.bases) around.bases(time, member.bases);
  fillBases(member);
}

const BaseMotion& BatchChain::baseOf(const Member& member, std::size_t link) const {
  static const BaseMotion GROUND;
  const auto base = static_cast<std::size_t>(member.base[link]);
  return base < member.bases.size() ? member.bases[base] : GROUND;
}

void BatchChain::fillBases(const Member& member) {
  ChainGroup& group = groups_[member.group];
  for (const int root : member.roots) {
    const auto link = static_cast<std::size_t>(root);
    const int place = slots_[member.first + link] - group.begin;
    group.bases[static_cast<std::size_t>(place)] = baseRows(baseOf(member, link));
  }
}

// Fills the rows of all links that have loads, or had some.
void BatchChain::fillLoads(const std::vector<std::size_t>& links, Member& member) {
  static const Loads NONE;
  if (store_->loads.empty()) store_->loads.assign(blocks() * L_ROWS);
  const auto fill = [&](const Loads& loads, std::size_t link) {
    fillLoad(loads, link, store_->loads.of(slots_[member.first + link], L_ROWS));
  };
  if (links.size() < member.count)
    for (const std::size_t link : member.loaded) fill(NONE, link);
  for (const std::size_t link : links) fill(loads_, link);
  if (member.loaded.size() != member.count || links.size() != member.count) member.loaded = links;
  store_->drag = store_->drag || !loads_.drag.empty();
}

void BatchChain::evaluateLoads(const Surroundings& around, double time, Member& member) {
  const bool few = loaded_ != nullptr;
  const std::vector<std::size_t>& links = few ? *loaded_ : member.by_slot;
  if (!few || loads_used_ || loads_.wrench.size() != member.count) loads_.clear(member.count);
  loads_used_ = !few;
  resize(kinematics_, member.count);
  const int begin = groups_[member.group].begin;
  for (const std::size_t i : links)
    readMotion(store_->scratch->motion.of(slots_[member.first + i] - begin, M_ROWS),
               baseOf(member, i).pose.position, i, kinematics_);
  around.loads(kinematics_, time, loads_);
  fillLoads(links, member);
}

void BatchChain::updateLoads(const Surroundings& around, double time, double h, Member& member) {
  if (!around.loads) {
    if (!member.loaded.empty()) fillLoads({}, member);
    return;
  }
  evaluateLoads(around, time, member);
  for (const Anchor& anchor : loads_.anchors) {
    const int slot = slots_[member.first + static_cast<std::size_t>(anchor.link)];
    store_->anchors.push_back(anchorRows(anchor, slot, member.theta * h));
  }
  if (!loaded_) return;
  for (const std::size_t link : *loaded_) {
    loads_.wrench[link] = Wrench();
    loads_.joint_torque[link] = Vec2::Zero();
  }
  loads_.anchors.clear();
  loads_.drag.clear();
}

// ---- air ---------------------------------------------------------------------------------------

void BatchChain::setGrips(int tree, const std::vector<Grip>& grips) {
  Member& member = this->member(tree);
  if (grips.size() != member.count)
    throw InvalidInput("grips: " + std::to_string(grips.size()) + "; one for each of the " +
                       std::to_string(member.count) + " links");
  if (store_->grips.empty()) {
    store_->grips.assign(blocks() * G_ROWS);
    store_->air.assign(blocks() * V_ROWS);
  }
  member.on_axis = std::all_of(grips.begin(), grips.end(), [](const Grip& grip) {
    return grip.centre.x() == 0.0 && grip.centre.y() == 0.0;
  });
  ChainGroup& group = groups_[member.group];
  group.on_axis = group.bars && std::all_of(group.trees.begin(), group.trees.end(),
                                            [&](std::size_t t) { return trees_[t].on_axis; });
  if (!group.on_axis && store_->beside.empty()) store_->beside.assign(blocks() * B_ROWS);
  for (std::size_t i = 0; i < member.count; ++i) {
    const int slot = slots_[member.first + i];
    fillGrip(grips[i], store_->grips.of(slot, G_ROWS),
             store_->beside.empty() ? nullptr : store_->beside.of(slot, B_ROWS));
  }
}

// Rows hold positions relative to the bases.
void BatchChain::queryWindOf(const ChainGroup& group) {
  for (const std::size_t t : group.trees) {
    const Member& member = trees_[t];
    for (std::size_t i = 0; i < member.count && !member.bases.empty(); ++i) {
      float* place = store_->scratch->places.of(slots_[member.first + i] - group.begin, V_ROWS);
      for (int axis = 0; axis < 3; ++axis)
        place[axis * ROW] += static_cast<float>(baseOf(member, i).pose.position[axis]);
    }
  }
  query_(store_->scratch->places.at(0), store_->air.of(group.begin, V_ROWS),
         static_cast<std::size_t>((group.end - group.begin) / ROW));
}

}  // namespace vegetation_sim::physics
