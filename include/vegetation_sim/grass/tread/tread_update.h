// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "vegetation_sim/grass/tread/tread_map.h"

namespace vegetation_sim::grass {

/// Stamp at which nodes were pressed, and their recovery time [s].
struct Press {
  Nanoseconds stamp{0};
  float recovery{0.f};
};

struct TreadNodeDelta {
  float tilt{0.f}, x{0.f}, y{0.f};  ///< as in TreadNode
  std::uint32_t press{0};           ///< index into TreadDelta::presses
};

/// Some nodes of a block, without loss.
struct TreadBlockDelta {
  int row{0}, column{0};  ///< index of the block
  /// bit i % 8 of byte i / 8 is set if node i is included
  std::array<std::uint8_t, 32> included{};
  std::vector<TreadNodeDelta> nodes;  ///< included nodes in the order of i
};
static_assert(TreadBlock::SIDE * TreadBlock::SIDE == 8 * 32, "TreadBlockDelta::included");

/// Some nodes of a block of cut ground, without loss.
struct CutBlockDelta {
  int row{0}, column{0};                    ///< index of the block
  std::array<std::uint8_t, 32> included{};  ///< as in TreadBlockDelta
  std::vector<CutNode> nodes;               ///< included nodes in the order of i
};

/// Trodden nodes in a message: without loss, 16 bytes a node; and cut nodes, 12 bytes each.
struct TreadDelta {
  std::vector<Press> presses;
  std::vector<TreadBlockDelta> blocks;
  std::vector<CutBlockDelta> cuts;
};

/// Selects nodes that were pressed after `since` and are not upright at `stamp`.
struct TreadInterval {
  Nanoseconds since{0}, stamp{0};
};

/// Returns all nodes that are not upright; the caller adds the cuts.
TreadDelta snapshotTreads(const TreadState& state, Nanoseconds stamp);
/// Returns all cut nodes.
std::vector<CutBlockDelta> snapshotCuts(const CutState& state);
/// Returns these nodes.
std::vector<CutBlockDelta> makeCutDelta(const CutState& state, const CutMap::Nodes& nodes);
/// Returns the nodes of these blocks that belong to the interval.
TreadDelta makeDelta(const TreadState& state, const std::set<std::pair<int, int>>& blocks,
                     const TreadInterval& interval);
/// Whether a block of this row and column is included.
using BlockFilter = std::function<bool(int row, int column)>;
/// Returns the included blocks, and the presses of their nodes.
TreadDelta selectBlocks(const TreadDelta& treads, const BlockFilter& includes);
/// Returns a hash of all values, which is equal for equal ground if all of it is included: the sum
/// modulo 2^64 of the hashes of its blocks, so that those of all shards add up to that of the
/// whole.
std::uint64_t hashOf(const TreadDelta& treads);
/// Adds a fault for each value that is not possible.
void check(const TreadDelta& treads, Faults& faults);
/// Applies a checked delta. @return number of nodes that are off the map or found no memory.
int applyDelta(const TreadDelta& treads, TreadMap& map);

/// One message about trodden ground.
struct TreadUpdate {
  Nanoseconds stamp{0};
  std::uint32_t sequence{0};
  bool key_frame{false};
  std::uint64_t layout_hash{0};
  std::uint64_t hash{0};   ///< in key frames, hashOf(treads); else 0
  std::uint32_t shard{0};  ///< whose blocks these are, of 0 to `shards`
  std::uint32_t shards{1};
  TreadDelta treads;
};

/// Keeps the trodden ground of another process, or of the shards of a meadow, in a TreadMap of the
/// same layout.
class TreadReplica {
 public:
  /// Applies a checked key frame, or the update that follows the last one of its shard. @return
  /// false if it was ignored because messages were lost; why() has the reason. The next key frame
  /// of the shard ends that. @throws InvalidInput for another number of shards than that of the
  /// messages in use, and for a block of another shard.
  bool apply(const TreadUpdate& update, TreadMap& map);
  /// Discards the state, after another layout or a jump back in time.
  void reset() { *this = TreadReplica(); }

  std::uint32_t shards() const { return static_cast<std::uint32_t>(parts_.size()); }
  /// Stamp of the last update of a shard that was applied. @param shard below shards().
  Nanoseconds stampOf(std::uint32_t shard) const { return parts_[shard].stamp; }
  /// Reason why the last update was ignored, or applied in part; empty if neither is so.
  const std::string& why() const { return why_; }

 private:
  /// The state of the messages of one shard.
  struct Part {
    bool in_sequence{false};
    std::uint32_t sequence{0};
    Nanoseconds stamp{0};
    std::string why;
  };
  Part& choosePart(const TreadUpdate& update, const TreadMap& map);
  void checkBlocks(const TreadUpdate& update, const TreadMap& map) const;

  std::vector<Part> parts_{Part()};           // by shard
  std::shared_ptr<const TileOwners> owners_;  // of several shards
  std::string why_;
};

}  // namespace vegetation_sim::grass
