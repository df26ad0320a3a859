// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "vegetation_sim/grass/blades/blade_batch.h"
#include "vegetation_sim/grass/map/feature_map.h"
#include "vegetation_sim/grass/tread/tread_law.h"

namespace vegetation_sim::grass {

/// Mass of a fresh leaf per area [kg/m^2].
constexpr double LEAF_MASS = 0.25;

/// An area in which blades are cut at a height: what is inside of the outline, also if it is not
/// convex, or within `radius` of it. One point is a disc, two are a capsule.
struct CutArea {
  static constexpr std::size_t MOST_POINTS = 1000;
  std::vector<Point> outline;  ///< world [m]
  double radius{0.0};          ///< 0 requires three points [m]
  double height{0.05};         ///< longest blade that is left [m]
  /// outline of the area on which the cut grass is laid; empty: where it grew
  std::vector<Point> swath;
};
/// Adds the faults of an area; `context` names it.
void check(const CutArea& area, const std::string& context, Faults& faults);

/// Cut grass at a node of the fine grid, for the square around it.
struct CutNode {
  float height{UNCUT};  ///< longest blade [m]
  double swath{0.0};    ///< cut grass that lies there [kg/m^2]
};

/// A square of nodes, some of which are cut or have cut grass on them.
struct CutBlock {
  static constexpr int SIDE = 16;
  std::array<CutNode, std::size_t{SIDE} * SIDE> nodes;  ///< row by row from the south
};

/// The state of a cut map, to be saved, restored and compared.
struct CutState {
  std::map<std::pair<int, int>, CutBlock> blocks;  ///< by row and column of the block
  std::uint64_t no_memory{0};                      ///< nodes that the memory cap left uncut

  bool empty() const { return blocks.empty() && no_memory == 0; }
  void addTo(Hash& hash) const;
};

/// Stubble and cut grass on the fine grid of a TreadMap, where grass was cut. Cut grass does not
/// grow again.
class CutMap {
 public:
  /// Limit of the work of an outline; it takes about half a second.
  static constexpr double MOST_WORK = 2e6;

  CutMap() : CutMap(MapLaw(), 1, 0.0) {}
  /// @param cells fine cells along a tile. @param memory_cap [bytes]
  CutMap(const MapLaw& law, int cells, double memory_cap);

  /// Cuts a checked area. A node is cut if it is inside; the mass of what is removed there is laid
  /// evenly on the nodes of the swath, or on the cut ones if there are none.
  /// @return the removed mass [kg]. @throws InvalidInput if the work exceeds MOST_WORK.
  double cut(const FeatureMap& map, const CutArea& area);
  /// @throws InvalidInput as cut() does.
  void checkWork(const CutArea& area) const;
  /// Returns the work of a checked area and its swath, in nodes of their bounding boxes and corners
  /// per row.
  double workOf(const CutArea& area) const;

  /// Returns the nearest node.
  CutNode at(const Point& place) const;
  /// Fills the heights and the swath of a tile's patch, which then has cells; or none if it is
  /// uncut.
  void patch(int tile_column, int tile_row, CrushPatch& out) const;

  /// Sets a node of a replica. @return false if it is not on the map or memory is full.
  bool put(int row, int column, const CutNode& node);
  /// Nodes by row and column of their block.
  using Nodes = std::map<std::pair<int, int>, std::bitset<CutBlock::SIDE * CutBlock::SIDE>>;
  /// Returns the nodes that cut() has changed since the last call.
  Nodes takeChanged() { return std::exchange(changed_, {}); }

  const CutState& state() const { return state_; }
  void restore(CutState state);
  /// Clears the blocks for which `selects(row, column)` is true.
  template <class Select>
  void clear(const Select& selects) {
    for (auto entry = state_.blocks.begin(); entry != state_.blocks.end();)
      entry = selects(entry->first.first, entry->first.second) ? state_.blocks.erase(entry)
                                                               : std::next(entry);
  }
  std::size_t bytes() const;

 private:
  using Places = std::vector<std::pair<int, int>>;  ///< rows and columns
  Places placesIn(const std::vector<Point>& outline, double radius) const;
  double workOf(const std::vector<Point>& outline, double radius) const;
  CutNode* nodeAt(const std::pair<int, int>& place);
  CutNode* changeAt(const std::pair<int, int>& place);
  CutNode nodeOf(int row, int column) const;
  bool lay(const Places& places, double mass);

  MapLaw law_;
  int cells_, last_column_, last_row_;
  double spacing_, memory_cap_;
  CutState state_;
  Nodes changed_;
};

/// Returns the mass per area of blades that are no longer than `longest` [kg/m^2].
double massBelow(const FeatureMap& map, const Features& features, double longest);

}  // namespace vegetation_sim::grass
