// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/time.h"
#include "vegetation_sim/grass/blades/blade_batch.h"
#include "vegetation_sim/grass/tread/cut_map.h"
#include "vegetation_sim/grass/tread/tread_law.h"

namespace vegetation_sim::grass {

class TileOwners;

struct TreadSettings {
  /// wanted spacing of the fine nodes; rounded so that it divides a tile [m]
  double spacing{0.05};
  /// limit for trodden ground and the doses of sources, and as much for cut ground [bytes]
  double memory_cap{128e6};
  double longest_stroke{5.0};  ///< A longer step is a jump, which leaves no track [m].
  double top_speed{40.0};      ///< A faster step is a jump, too [m/s].
};
void describe(FieldVisitor& visitor, TreadSettings& settings);

/// Trodden grass at a node: its tilt at `stamp`, from which it recovers.
struct TreadNode {
  float tilt{0.f};       ///< [rad]
  float x{0.f}, y{0.f};  ///< unit direction in which the blades lie
  float recovery{0.f};   ///< [s]
  Nanoseconds stamp{0};
};

/// A square of nodes of trodden ground.
struct TreadBlock {
  static constexpr int SIDE = 16;
  Nanoseconds until{0};  ///< stamp at which the last node has recovered
  std::array<TreadNode, std::size_t{SIDE} * SIDE> nodes;  ///< row by row from the south
};

/// A source on the ground. The doses of the nodes within its reach add up while it stays near them,
/// which is one pass.
struct TreadSource {
  Point position, along;
  bool has_moved{false};  ///< `along` is valid
  Nanoseconds stamp{0};
  int first_column{0}, first_row{0}, columns{0}, rows{0};  ///< window of nodes, whole vectors wide
  std::vector<double> doses;                               ///< [rows x columns] [1/m^2]
};

/// Counts since the start.
struct TreadCounts {
  std::uint64_t strokes{0};    ///< strokes that were applied
  std::uint64_t invalid{0};    ///< inputs that were rejected: not finite or back in time
  std::uint64_t jumps{0};      ///< jumps of a source, which leave no track
  std::uint64_t outside{0};    ///< strokes that touched no node of the map
  std::uint64_t no_memory{0};  ///< nodes that the memory cap left untrodden
};

/// The state of a tread map, to be saved, restored and compared.
struct TreadState {
  std::map<std::pair<int, int>, TreadBlock> blocks;  ///< by row and column of the block
  std::map<std::uint32_t, TreadSource> sources;
  TreadCounts counts;

  std::uint64_t hash() const;
};

/// Hash table of recently found entries. A copy is empty, since entries point into one map's parts.
/// @tparam Entry is constructed from a key and has mixed(key...) and is(key...).
template <class Entry, int BITS>
class RecentTable {
 public:
  RecentTable() = default;
  RecentTable(const RecentTable&) {}
  RecentTable& operator=(const RecentTable&) {
    clear();
    return *this;
  }
  /// Returns the entry of a key; its pointers are null if nothing is known, and may be set.
  template <class... Key>
  Entry& at(Key... key) {
    if (entries_.empty()) entries_.resize(std::size_t{1} << BITS);
    Entry& entry = entries_[Entry::mixed(key...) >> (32 - BITS)];
    if (!entry.is(key...)) entry = Entry(key...);
    return entry;
  }
  void clear() { entries_.clear(); }

 private:
  std::vector<Entry> entries_;
};

struct RecentBlock {
  RecentBlock() = default;
  RecentBlock(int row_wanted, int column_wanted) : row(row_wanted), column(column_wanted) {}
  static std::uint32_t mixed(int row, int column) {
    return static_cast<std::uint32_t>(row) * 0x9E3779B1U +
           static_cast<std::uint32_t>(column) * 0x85EBCA77U;
  }
  bool is(int other_row, int other_column) const {
    return row == other_row && column == other_column;
  }
  int row{-1}, column{-1};
  bool is_known{false};  ///< `block` is valid, also if it is null
  TreadBlock* block{nullptr};
};

struct RecentSource {
  RecentSource() = default;
  explicit RecentSource(std::uint32_t wanted) : id(wanted) {}
  static std::uint32_t mixed(std::uint32_t id) { return id * 0x9E3779B1U; }
  bool is(std::uint32_t other) const { return id == other; }
  std::uint32_t id{0};
  TreadSource* source{nullptr};
};

/// Nodes that a stroke presses down, row by row, and the number of nodes within its reach.
struct TreadPresses {
  std::vector<std::uint64_t> places;  ///< row << 32 | column
  std::vector<double> tilts;          ///< tilts of the stroke [rad]
  std::size_t count{0};
  int touched{0};
};

struct TreadBand;
struct TreadGrid;
struct TreadStroke;

/// Trodden grass (paper 2, section 4.2; S2-21 to S2-28) on a fine grid that exists only where a
/// source trod (S2-W1). Nothing happens per frame: the recovery of a node is a function of its
/// stamp. One thread at a time. The values have the same bits on every processor.
class TreadMap {
 public:
  /// @param owners whose shard's blocks are pressed, those of others stay upright; null: all are.
  /// @throws InvalidInput with all faults.
  TreadMap(const MapLaw& law, const TreadSettings& settings,
           std::shared_ptr<const TileOwners> owners = nullptr);

  /// Moves a source, or puts it down, and presses the segment from its last position to `position`
  /// [m]. A position that is not finite, a jump or a stamp before the last one leaves no track and
  /// is counted, as does a source for whose doses there is no memory. Requires a checked law.
  /// @return number of nodes within reach.
  int tread(std::uint32_t source, const TreadLaw& law, const Point& position, Nanoseconds stamp);
  /// Takes the source off the ground; its next tread() begins a new track.
  void lift(std::uint32_t source);

  /// Returns the nearest node as it is at a stamp; its tilt is 0 if it is untrodden.
  TreadNode at(const Point& place, Nanoseconds stamp) const;
  /// Fills the patch of a tile, with 0 cells if it is neither trodden nor cut. `out` keeps its
  /// memory.
  void patch(int tile_column, int tile_row, Nanoseconds stamp, CrushPatch& out) const;

  /// Frees blocks that have recovered.
  void prune(Nanoseconds stamp);
  void clear();
  /// Raises all nodes within `radius` [m] of a place.
  void raise(const Point& place, double radius);
  /// Sets a node of a replica. @return false if it is not on the map or memory is full.
  bool put(int row, int column, const TreadNode& node);

  /// Cut grass, which raise(), restore() and prune() leave.
  CutMap& cuts() { return cuts_; }
  const CutMap& cuts() const { return cuts_; }

  const TreadState& state() const { return state_; }
  void restore(TreadState state);
  /// Clears trodden and cut ground in the blocks of one shard.
  void clearShard(const TileOwners& owners, std::uint32_t shard);
  const MapLaw& law() const { return law_; }
  double spacing() const { return spacing_; }
  /// Fine cells along a tile.
  int cells() const { return cells_; }
  const TileOwners& owners() const { return *owners_; }
  std::size_t bytes() const;

 private:
  static constexpr int SIDE = TreadBlock::SIDE;

  /// Range of nodes, both ends included.
  struct Box {
    int first_column, last_column, first_row, last_row;
  };
  TreadBlock* blockAt(int row, int column, bool make);
  TreadSource* sourceOf(std::uint32_t id);
  bool isJump(const TreadSource& from, const Point& to, Nanoseconds stamp) const;
  bool hasRoom(std::size_t more) const;
  bool moveWindow(TreadSource& source, double reach);
  void resizeDoses(TreadSource& source, std::size_t count);
  TreadGrid grid() const;
  Box boxOf(const Point& low, const Point& high, double reach) const;
  double fullDose(const TreadLaw& law);
  int pressWindow(TreadStroke& stroke);
  int pressBands(TreadStroke& stroke);
  int pressBand(TreadStroke& stroke, const TreadBand& band);
  bool ownsAnyOf(const Box& box) const;
  void dropWindow(TreadSource& source);
  void prefetch(const TreadBand& band);
  void forgetRecent();

  MapLaw law_;
  TreadSettings settings_;
  std::shared_ptr<const TileOwners> owners_;
  int cells_;  ///< fine cells along a tile
  double spacing_, per_spacing_;
  CutMap cuts_;
  TreadState state_;
  std::size_t doses_count_{0};  ///< of all sources
  RecentTable<RecentBlock, 16> recent_blocks_;
  RecentTable<RecentSource, 12> recent_sources_;
  TreadSource before_;         ///< scratch: the window before the step
  std::vector<double> doses_;  ///< scratch: doses that are copied between windows
  TreadPresses presses_;       ///< scratch
  TreadLaw last_law_{};        ///< law of the last stroke
  double last_full_{0.0};      ///< fullDose() of last_law_
};

/// A node with less tilt counts as untrodden [rad].
constexpr float CRUNCHED = 0.0174533f;

}  // namespace vegetation_sim::grass
