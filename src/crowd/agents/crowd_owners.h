// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/shards/shard_split.h"
#include "crowd/agents/crowd.h"

namespace vegetation_sim::crowd {

/// Which shard owns which place: a pure function of the area and the number of shards. The area is
/// divided into 32 x 32 cells, of which shards have successive stretches along a Morton curve. A
/// place outside belongs to the owner of the nearest cell.
class CrowdOwners {
 public:
  /// One shard owns all places.
  CrowdOwners() = default;
  /// @throws InvalidInput for a shard that check() refuses.
  CrowdOwners(const Area& area, const Shard& shard);

  const Shard& shard() const { return shard_; }
  std::uint32_t ownerAt(const Point& place) const;
  bool owns(const Point& place) const { return ownerAt(place) == shard_.index; }
  /// Returns whether another shard than shard() owns a place in the square of half side `margin`
  /// around this one [m].
  bool isNearOthers(const Point& place, double margin) const;

 private:
  static constexpr int SIDE = 32;
  int columnOf(double x) const;
  int rowOf(double y) const;

  Shard shard_;
  Area area_;
  std::vector<std::uint16_t> owners_;  // of cells, row by row from the south; none for one shard
};

}  // namespace vegetation_sim::crowd
