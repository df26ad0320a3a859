// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/agents/crowd_owners.h"

#include <algorithm>

namespace vegetation_sim::crowd {
namespace {

int cellOf(double x, double low, double high, int cells) {
  const double part = high > low ? (x - low) / (high - low) * cells : 0.0;
  return static_cast<int>(std::min(cells - 1.0, std::max(0.0, part)));
}

}  // namespace

CrowdOwners::CrowdOwners(const Area& area, const Shard& shard) : shard_(shard), area_(area) {
  Faults faults;
  check(shard, faults);
  faults.throwIfAny();
  if (shard.count == 1) return;
  std::vector<ShardUnit> units;
  for (int row = 0; row < SIDE; ++row)
    for (int column = 0; column < SIDE; ++column)
      units.push_back({area.min_x + (column + 0.5) / SIDE * (area.max_x - area.min_x),
                       area.min_y + (row + 0.5) / SIDE * (area.max_y - area.min_y), 1});
  owners_ = assignShards(units, shard.count);
}

int CrowdOwners::columnOf(double x) const {
  return cellOf(x, area_.min_x, area_.max_x, SIDE);
}

int CrowdOwners::rowOf(double y) const {
  return cellOf(y, area_.min_y, area_.max_y, SIDE);
}

std::uint32_t CrowdOwners::ownerAt(const Point& place) const {
  if (owners_.empty()) return 0;
  return owners_[static_cast<std::size_t>(rowOf(place.y) * SIDE + columnOf(place.x))];
}

bool CrowdOwners::isNearOthers(const Point& place, double margin) const {
  if (owners_.empty()) return false;
  for (int row = rowOf(place.y - margin); row <= rowOf(place.y + margin); ++row)
    for (int column = columnOf(place.x - margin); column <= columnOf(place.x + margin); ++column)
      if (owners_[static_cast<std::size_t>(row * SIDE + column)] != shard_.index) return true;
  return false;
}

}  // namespace vegetation_sim::crowd
