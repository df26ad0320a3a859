// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/tread/tread_update.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "grass/map/tile_owners.h"
#include "grass/tread/tread_recovery.h"
#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/grass/blades/blade.h"

namespace vegetation_sim::grass {
namespace {

constexpr int LAST_BLOCK = 1 << 24;  // its nodes have whole numbers

// Numbers the presses of a delta. The last one is cached, since neighbours were mostly pressed
// together.
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

bool isIncludedIn(const TreadNode& node, const TreadInterval& interval) {
  return node.stamp > interval.since && tiltAt(node, interval.stamp) > 0.f;
}

void report(const std::pair<int, int>& place, const TreadBlock& block,
            const TreadInterval& interval, Presses& presses, TreadDelta& out) {
  TreadBlockDelta published{place.first, place.second, {}, {}};
  for (std::size_t i = 0; i < block.nodes.size(); ++i) {
    const TreadNode& node = block.nodes[i];
    if (!isIncludedIn(node, interval)) continue;
    published.included[i / 8] |= static_cast<std::uint8_t>(1u << (i % 8));
    published.nodes.push_back({node.tilt, node.x, node.y, presses.numberOf(node)});
  }
  if (!published.nodes.empty()) out.blocks.push_back(std::move(published));
}

// Appends the nodes that `selects(i, node)` selects, if there are any.
template <class Select>
void reportCuts(const std::pair<int, int>& place, const CutBlock& block, const Select& selects,
                std::vector<CutBlockDelta>& out) {
  CutBlockDelta published{place.first, place.second, {}, {}};
  for (std::size_t i = 0; i < block.nodes.size(); ++i) {
    if (!selects(i, block.nodes[i])) continue;
    published.included[i / 8] |= static_cast<std::uint8_t>(1u << (i % 8));
    published.nodes.push_back(block.nodes[i]);
  }
  if (!published.nodes.empty()) out.push_back(std::move(published));
}

// Checks what blocks of trodden and of cut ground have in common.
template <class Block>
void checkBlock(const Block& block, const std::string& name, Faults& faults) {
  if (std::min(block.row, block.column) < 0 || std::max(block.row, block.column) > LAST_BLOCK)
    faults.add(name + "row and column are outside 0 to " + std::to_string(LAST_BLOCK));
  std::size_t published = 0;
  for (const unsigned byte : block.included)
    for (unsigned bits = byte; bits; bits &= bits - 1) ++published;
  if (published != block.nodes.size())
    faults.add(name + std::to_string(block.nodes.size()) + " nodes where " +
               std::to_string(published) + " are included");
}

void checkCuts(const std::vector<CutBlockDelta>& cuts, Faults& faults) {
  for (const CutBlockDelta& block : cuts) {
    const std::string name = "state: cut block " + std::to_string(block.row) + ", " +
                             std::to_string(block.column) + ": ";
    checkBlock(block, name, faults);
    FieldChecker checker(name, faults);
    for (CutNode node : block.nodes) {
      double height = double{node.height};
      checker.number("height", height, "m", {0.0, double{UNCUT}});
      checker.number("swath", node.swath, "kg/m^2", {0.0, 1e9});
    }
  }
}

// Calls `put(row, column, node)` for each included node. @return number of nodes it refused.
template <class Block, class Put>
int putNodes(const Block& block, const Put& put) {
  constexpr int SIDE = TreadBlock::SIDE;
  int refused = 0;
  std::size_t next = 0;
  for (int i = 0; i < SIDE * SIDE; ++i)
    if (block.included[static_cast<std::size_t>(i / 8)] >> (i % 8) & 1)
      refused +=
          !put(block.row * SIDE + i / SIDE, block.column * SIDE + i % SIDE, block.nodes[next++]);
  return refused;
}

}  // namespace

std::vector<CutBlockDelta> snapshotCuts(const CutState& state) {
  std::vector<CutBlockDelta> out;
  const auto isCut = [](std::size_t, const CutNode& node) {
    return node.height < UNCUT || node.swath > 0.0;
  };
  for (const auto& [place, block] : state.blocks) reportCuts(place, block, isCut, out);
  return out;
}

std::vector<CutBlockDelta> makeCutDelta(const CutState& state, const CutMap::Nodes& nodes) {
  std::vector<CutBlockDelta> out;
  for (const auto& [place, changed] : nodes) {
    const auto& mask = changed;
    if (const auto found = state.blocks.find(place); found != state.blocks.end())
      reportCuts(
          place, found->second, [&](std::size_t i, const CutNode&) { return mask[i]; }, out);
  }
  return out;
}

TreadDelta snapshotTreads(const TreadState& state, Nanoseconds stamp) {
  TreadDelta out;
  Presses presses(out.presses);
  for (const auto& [place, block] : state.blocks)
    report(place, block, {std::numeric_limits<Nanoseconds>::min(), stamp}, presses, out);
  return out;
}

TreadDelta makeDelta(const TreadState& state, const std::set<std::pair<int, int>>& blocks,
                     const TreadInterval& interval) {
  TreadDelta out;
  Presses presses(out.presses);
  for (const auto& place : blocks) {
    const auto found = state.blocks.find(place);
    if (found != state.blocks.end()) report(place, found->second, interval, presses, out);
  }
  return out;
}

TreadDelta selectBlocks(const TreadDelta& treads, const BlockFilter& includes) {
  TreadDelta out;
  std::map<std::uint32_t, std::uint32_t> presses;  // new number by the old one
  for (TreadBlockDelta block : treads.blocks) {
    if (!includes(block.row, block.column)) continue;
    for (TreadNodeDelta& node : block.nodes) {
      const auto [press, is_new] =
          presses.insert({node.press, static_cast<std::uint32_t>(out.presses.size())});
      if (is_new) out.presses.push_back(treads.presses[node.press]);
      node.press = press->second;
    }
    out.blocks.push_back(std::move(block));
  }
  for (const CutBlockDelta& block : treads.cuts)
    if (includes(block.row, block.column)) out.cuts.push_back(block);
  return out;
}

std::uint64_t hashOf(const TreadDelta& treads) {
  std::uint64_t sum = 0;
  const auto begin = [](const auto& block, std::uint64_t kind) {
    Hash hash;
    hash.add(kind);
    hash.add(static_cast<std::uint64_t>(block.row));
    hash.add(static_cast<std::uint64_t>(block.column));
    for (const std::uint8_t byte : block.included) hash.add(static_cast<std::uint64_t>(byte));
    return hash;
  };
  for (const TreadBlockDelta& block : treads.blocks) {
    Hash hash = begin(block, 0);
    for (const TreadNodeDelta& node : block.nodes) {
      for (const float value : {node.tilt, node.x, node.y, treads.presses[node.press].recovery})
        hash.add(double{value});
      hash.add(static_cast<std::uint64_t>(treads.presses[node.press].stamp));
    }
    sum += hash.value();
  }
  for (const CutBlockDelta& block : treads.cuts) {
    Hash hash = begin(block, 1);
    for (const CutNode& node : block.nodes) {
      hash.add(double{node.height});
      hash.add(node.swath);
    }
    sum += hash.value();
  }
  return sum;
}

void check(const TreadDelta& treads, Faults& faults) {
  for (const Press& press : treads.presses) {
    const std::string fault =
        rangeFault("state: recovery", double{press.recovery}, "s", {0.0, PERMANENT_RECOVERY});
    if (!fault.empty()) faults.add(fault);
  }
  for (const TreadBlockDelta& block : treads.blocks) {
    const std::string name =
        "state: block " + std::to_string(block.row) + ", " + std::to_string(block.column) + ": ";
    checkBlock(block, name, faults);
    for (const TreadNodeDelta& node : block.nodes) {
      if (node.press >= treads.presses.size())
        faults.add(name + "press = " + std::to_string(node.press) + " is outside 0 to " +
                   std::to_string(treads.presses.size()) + " less one");
      const bool sound = node.tilt >= 0.f && double{node.tilt} <= BEND_LIMIT &&
                         std::fabs(node.x) <= 1.001f && std::fabs(node.y) <= 1.001f;
      if (!sound) faults.add(name + "a tilt or direction is impossible");
    }
  }
  checkCuts(treads.cuts, faults);
}

int applyDelta(const TreadDelta& treads, TreadMap& map) {
  int refused = 0;
  for (const TreadBlockDelta& block : treads.blocks)
    refused += putNodes(block, [&](int row, int column, const TreadNodeDelta& node) {
      const Press& press = treads.presses[node.press];
      return map.put(row, column, {node.tilt, node.x, node.y, press.recovery, press.stamp});
    });
  for (const CutBlockDelta& block : treads.cuts)
    refused += putNodes(block, [&](int row, int column, const CutNode& node) {
      return map.cuts().put(row, column, node);
    });
  return refused;
}

TreadReplica::Part& TreadReplica::choosePart(const TreadUpdate& update, const TreadMap& map) {
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
  if (shard.count != shards() || !owners_) {
    owners_ = std::make_shared<const TileOwners>(map.law(), shard);
    parts_.assign(shard.count, Part());
  }
  return parts_[shard.index];
}

void TreadReplica::checkBlocks(const TreadUpdate& update, const TreadMap& map) const {
  if (shards() == 1) return;
  const auto require = [&](const auto& block) {
    const std::uint32_t owner = owners_->ownerOfBlock(block.row, block.column, map.cells());
    if (owner != update.shard)
      throw InvalidInput("state: block " + std::to_string(block.row) + ", " +
                         std::to_string(block.column) + " belongs to shard " +
                         std::to_string(owner) + ", but the message is of shard " +
                         std::to_string(update.shard));
  };
  for (const TreadBlockDelta& block : update.treads.blocks) require(block);
  for (const CutBlockDelta& block : update.treads.cuts) require(block);
}

bool TreadReplica::apply(const TreadUpdate& update, TreadMap& map) {
  Part& part = choosePart(update, map);
  checkBlocks(update, map);
  if (!update.key_frame && !(part.in_sequence && update.sequence == part.sequence + 1)) {
    part.why = part.in_sequence   ? "messages were lost"
               : part.why.empty() ? "no key frame yet"
                                  : part.why;
    part.in_sequence = false;
    why_ = part.why;
    return false;
  }
  if (update.key_frame && shards() == 1) map.clear();
  if (update.key_frame && shards() > 1) map.clearShard(*owners_, update.shard);
  const int refused = applyDelta(update.treads, map);
  part.in_sequence = true;
  part.sequence = update.sequence;
  part.stamp = update.stamp;
  part.why =
      refused > 0 ? std::to_string(refused) + " nodes are off the map or find no memory" : "";
  why_ = part.why;
  return true;
}

}  // namespace vegetation_sim::grass
