// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/tread/tread_update.h"

#include <cmath>
#include <limits>
#include <map>

#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/grass/blades/blade.h"

namespace vegetation_sim::grass {
namespace {

constexpr int SIDE = TreadBlock::SIDE;

// Presses that were told, by number. Neighbours were mostly pressed together.
class Presses {
 public:
  explicit Presses(std::vector<Press>& list) : list_(list) {}
  std::uint32_t numberOf(const TreadNode& node) {
    const std::pair<Nanoseconds, float> wanted{node.stamp, node.recovery};
    if (!last_ || last_->first != wanted) {
      const auto [press, is_new] =
          numbers_.insert({wanted, static_cast<std::uint32_t>(list_.size())});
      if (is_new) list_.push_back({node.stamp, node.recovery});
      last_ = &*press;
    }
    return last_->second;
  }

 private:
  std::vector<Press>& list_;
  std::map<std::pair<Nanoseconds, float>, std::uint32_t> numbers_;
  const std::pair<const std::pair<Nanoseconds, float>, std::uint32_t>* last_{nullptr};
};

bool isToldIn(const TreadNode& node, const Telling& telling) {
  return node.stamp > telling.since && tiltAt(node, telling.stamp) > 0.f;
}

void tell(const std::pair<int, int>& place, const TreadBlock& block, const Telling& telling,
          Presses& presses, ToldTreads& out) {
  ToldBlock told{place.first, place.second, {}, {}};
  for (std::size_t i = 0; i < block.nodes.size(); ++i) {
    const TreadNode& node = block.nodes[i];
    if (!isToldIn(node, telling)) continue;
    told.told[i / 8] |= static_cast<std::uint8_t>(1u << (i % 8));
    told.nodes.push_back({node.tilt, node.x, node.y, presses.numberOf(node)});
  }
  if (!told.nodes.empty()) out.blocks.push_back(std::move(told));
}

}  // namespace

ToldTreads tellAll(const TreadState& state, Nanoseconds stamp) {
  ToldTreads out;
  Presses presses(out.presses);
  for (const auto& [place, block] : state.blocks)
    tell(place, block, {std::numeric_limits<Nanoseconds>::min(), stamp}, presses, out);
  return out;
}

ToldTreads tellSince(const TreadState& state, const std::set<std::pair<int, int>>& blocks,
                     const Telling& telling) {
  ToldTreads out;
  Presses presses(out.presses);
  for (const auto& place : blocks) {
    const auto found = state.blocks.find(place);
    if (found != state.blocks.end()) tell(place, found->second, telling, presses, out);
  }
  return out;
}

std::uint64_t hashOf(const ToldTreads& treads) {
  Hash hash;
  for (const ToldBlock& block : treads.blocks) {
    hash.add(static_cast<std::uint64_t>(block.row));
    hash.add(static_cast<std::uint64_t>(block.column));
    for (const std::uint8_t byte : block.told) hash.add(static_cast<std::uint64_t>(byte));
    for (const ToldNode& node : block.nodes) {
      for (const float value : {node.tilt, node.x, node.y, treads.presses[node.press].recovery})
        hash.add(double{value});
      hash.add(static_cast<std::uint64_t>(treads.presses[node.press].stamp));
    }
  }
  return hash.value();
}

void check(const ToldTreads& treads, Faults& faults) {
  for (const Press& press : treads.presses) {
    const std::string fault =
        rangeFault("state: recovery", double{press.recovery}, "s", {0.0, PERMANENT_RECOVERY});
    if (!fault.empty()) faults.add(fault);
  }
  for (const ToldBlock& block : treads.blocks) {
    const std::string name =
        "state: block " + std::to_string(block.row) + ", " + std::to_string(block.column) + ": ";
    std::size_t told = 0;
    for (const unsigned byte : block.told)
      for (unsigned bits = byte; bits; bits &= bits - 1) ++told;
    if (told != block.nodes.size())
      faults.add(name + std::to_string(block.nodes.size()) + " nodes where " +
                 std::to_string(told) + " are told");
    for (const ToldNode& node : block.nodes) {
      if (node.press >= treads.presses.size())
        faults.add(name + "press = " + std::to_string(node.press) + " is outside 0 to " +
                   std::to_string(treads.presses.size()) + " less one");
      const bool sound = node.tilt >= 0.f && double{node.tilt} <= BEND_LIMIT &&
                         std::fabs(node.x) <= 1.001f && std::fabs(node.y) <= 1.001f;
      if (!sound) faults.add(name + "a tilt or direction cannot be");
    }
  }
}

int adopt(const ToldTreads& treads, TreadMap& map) {
  int refused = 0;
  for (const ToldBlock& block : treads.blocks) {
    std::size_t next = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
      if (!(block.told[static_cast<std::size_t>(i / 8)] >> (i % 8) & 1)) continue;
      const ToldNode& node = block.nodes[next++];
      const Press& press = treads.presses[node.press];
      refused += !map.put(block.row * SIDE + i / SIDE, block.column * SIDE + i % SIDE,
                          {node.tilt, node.x, node.y, press.recovery, press.stamp});
    }
  }
  return refused;
}

bool TreadReplica::apply(const TreadUpdate& update, TreadMap& map) {
  if (!update.key_frame && !(in_sequence_ && update.sequence == sequence_ + 1)) {
    why_ = in_sequence_ ? "messages were lost" : why_.empty() ? "no key frame yet" : why_;
    in_sequence_ = false;
    return false;
  }
  if (update.key_frame) map.clear();
  const int refused = adopt(update.treads, map);
  in_sequence_ = true;
  sequence_ = update.sequence;
  stamp_ = update.stamp;
  why_ = refused > 0 ? std::to_string(refused) + " nodes are off the map or find no memory" : "";
  return true;
}

}  // namespace vegetation_sim::grass
