// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "vegetation_sim/grass/tread/tread_map.h"

namespace vegetation_sim::grass {

/// When nodes were pressed, and how long they take from then [s].
struct Press {
  Nanoseconds stamp{0};
  float recovery{0.f};
};

struct TreadNodeDelta {
  float tilt{0.f}, x{0.f}, y{0.f};  ///< as in TreadNode
  std::uint32_t press{0};           ///< index into TreadDelta::presses
};

/// Some nodes of a block, exactly.
struct TreadBlockDelta {
  int row{0}, column{0};                    ///< of the block
  std::array<std::uint8_t, 32> included{};  ///< bit i % 8 of byte i / 8: node i is told
  std::vector<TreadNodeDelta> nodes;        ///< those, by rising i
};
static_assert(TreadBlock::SIDE * TreadBlock::SIDE == 8 * 32, "TreadBlockDelta::included");

/// Trodden nodes as one process tells them to another: to the bit, 16 bytes each.
struct TreadDelta {
  std::vector<Press> presses;
  std::vector<TreadBlockDelta> blocks;
};

/// What is told: nodes pressed later than `since` that are not upright at `stamp`.
struct TreadInterval {
  Nanoseconds since{0}, stamp{0};
};

/// Every node that is not upright.
TreadDelta snapshotTreads(const TreadState& state, Nanoseconds stamp);
/// Nodes of these blocks that were pressed since.
TreadDelta makeDelta(const TreadState& state, const std::set<std::pair<int, int>>& blocks,
                     const TreadInterval& interval);
/// Of every value that is told; equal for equal ground, if all of it is told.
std::uint64_t hashOf(const TreadDelta& treads);
/// Adds a fault for whatever cannot be.
void check(const TreadDelta& treads, Faults& faults);
/// Requires checked treads. @return nodes that are off the map or found no memory.
int applyDelta(const TreadDelta& treads, TreadMap& map);

/// One message about trodden ground.
struct TreadUpdate {
  Nanoseconds stamp{0};
  std::uint32_t sequence{0};
  bool key_frame{false};
  std::uint64_t layout_hash{0};
  std::uint64_t hash{0};  ///< in key frames, hashOf(treads); else 0
  TreadDelta treads;
};

/// Keeps another process's trodden ground in a TreadMap of the same layout.
class TreadReplica {
 public:
  /// Takes a checked key frame, or the update that follows what is held. False: it is ignored until
  /// the next key frame, because messages were lost; why() says so.
  bool apply(const TreadUpdate& update, TreadMap& map);
  /// What is held is void: the layout changed or time went back.
  void reset() { *this = TreadReplica(); }

  Nanoseconds stamp() const { return stamp_; }
  const std::string& why() const { return why_; }

 private:
  bool in_sequence_{false};
  std::uint32_t sequence_{0};
  Nanoseconds stamp_{0};
  std::string why_;
};

}  // namespace vegetation_sim::grass
