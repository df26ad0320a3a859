// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/TreadEvent.h>

#include <string>
#include <unordered_set>
#include <vector>

#include "grass/map/tile_owners.h"

namespace vegetation_sim {

/// Chooses which treads a shard of a meadow needs: those that are so near to its tiles that they or
/// their successors may press one. Its ground is the same without the others.
class NearTreads {
 public:
  /// A tread is applied, or lifts its source, which has left the region of the shard, or is
  /// ignored.
  enum class Use { ALL, LIFT, NONE };

  /// @param margin from tiles of the shard at which a tread is far [m]; see marginOf().
  NearTreads(const grass::MapLaw& law, const grass::TileOwners& owners, double margin);

  /// Returns a margin for tracks of this kind: a source that presses a tile has been nearer for two
  /// strokes before that. @param block side of a TreadBlock [m].
  static double marginOf(double longest_stroke, double block);

  /// @param event in the world frame. @param is_known whether the meadow has its source.
  Use useOf(const TreadEvent& event, bool is_known);
  /// To be called for each event of which all is used, once it has been checked.
  void keep(const TreadEvent& event);

  static constexpr std::size_t MOST_NAMES = 100000;

 private:
  bool isFar(const geometry_msgs::Point& place) const;
  bool isFar(const TreadEvent& event) const;

  grass::MapLaw law_;
  std::vector<char> is_near_;             // tiles, row by row from the south; none for one shard
  std::unordered_set<std::string> near_;  // names of sources
  bool is_full_{false};                   // there were more names
};

}  // namespace vegetation_sim
