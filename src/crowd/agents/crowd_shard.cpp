// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/agents/crowd_shard.h"

#include <algorithm>
#include <utility>

namespace vegetation_sim::crowd {
namespace {

constexpr double MOST_RADIUS = 1.0;  // radius of a person [m]

}  // namespace

CrowdBorder CrowdShard::endTick() {
  CrowdBorder out;
  out.stamp = crowd_.snapshot().stamp;
  const double margin = crowd_.snapshot().settings.sensor_range + 2.0 * MOST_RADIUS;
  for (const Walker& walker : crowd_.walkers())
    if (owners_.isNearOthers(walker.position, margin)) out.near.push_back(walker);
  left_ = crowd_.takeOutside(owners_);
  for (const Walker& walker : left_)
    out.handed.push_back({owners_.ownerAt(walker.position), walker});
  return out;
}

void CrowdShard::beginTick(const std::vector<CrowdBorder>& others) {
  std::vector<Walker> seen = left_;
  for (const CrowdBorder& border : others) {
    for (const CrowdBorder::Handed& handed : border.handed)
      if (handed.to == owners_.shard().index && !crowd_.find(handed.walker.id))
        crowd_.takeIn(handed.walker);
    seen.insert(seen.end(), border.near.begin(), border.near.end());
  }
  seen.erase(std::remove_if(seen.begin(), seen.end(),
                            [this](const Walker& walker) { return crowd_.find(walker.id); }),
             seen.end());
  std::sort(seen.begin(), seen.end(), [](const Walker& a, const Walker& b) { return a.id < b.id; });
  crowd_.setOthers(std::move(seen));
}

}  // namespace vegetation_sim::crowd
