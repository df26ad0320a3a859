// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/GrassCover.h>
#include <vegetation_sim/GrassCoverPart.h>

#include <cstdint>
#include <map>
#include <optional>

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Joins the trodden cells of all shards of a meadow to one cover map per period: once those of its
/// tick have come from all shards, or when the next map begins, with the last ones of shards that
/// are late. Until all shards have been heard, or for SHARD_SILENCE, there is no map.
class CoverJoin {
 public:
  /// @param shards their number, from 2 on.
  explicit CoverJoin(std::uint32_t shards) : shards_(shards) {}

  /// Begins a map with what this node knows of it, all but `resistance`. @param drag as in
  /// addResistance(). @return the map before, if it has not been taken.
  std::optional<GrassCover> begin(GrassCover own, double drag);
  /// Adds a part. It is ignored if its map has been taken. @throws InvalidInput for a part of
  /// another shard than 1 to `shards`, of another grid, or of impossible values.
  void add(const GrassCoverPart& part);
  /// Returns the map once it is complete.
  std::optional<GrassCover> take();
  void clear();

 private:
  void check(const GrassCoverPart& part) const;
  bool hasHeardAll() const;
  GrassCover join();

  std::uint32_t shards_;
  double drag_{0.0};
  std::optional<GrassCover> begun_;
  std::optional<Nanoseconds> since_;                                      // stamp of the first map
  std::optional<nav_msgs::MapMetaData> grid_;                             // of the last map
  std::map<std::uint32_t, std::map<Nanoseconds, GrassCoverPart>> parts_;  // by shard and tick
};

}  // namespace vegetation_sim
