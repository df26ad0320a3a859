// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/agents/crowd_shard.h"

#include <algorithm>
#include <utility>

namespace vegetation_sim::crowd {
namespace {

constexpr double MOST_RADIUS = 1.0;  // of a person [m]

}  // namespace

CrowdBorder CrowdShard::endTick() {
  CrowdBorder out;
  out.stamp = crowd_->snapshot().stamp;
  const double margin = crowd_->snapshot().settings.sensor_range + 2.0 * MOST_RADIUS;
  for (const Walker& walker : crowd_->walkers())
    if (owners_.isNearOthers(walker.position, margin)) out.near.push_back(walker);
  left_ = crowd_->takeOutside(owners_);
  for (const Walker& walker : left_)
    handed_.push_back({owners_.ownerAt(walker.position), out.stamp, walker});
  out.handed = handed_;
  for (const auto& [shard, border] : borders_) out.heard[shard] = border.stamp;
  return out;
}

void CrowdShard::hear(std::uint32_t shard, CrowdBorder border) {
  const Shard& own = owners_.shard();
  if (shard >= own.count || shard == own.index)
    throw InvalidInput("border: shard = " + std::to_string(shard) + " is no other shard of the " +
                       std::to_string(own.count) + " than this one, " + std::to_string(own.index));
  const auto last = borders_.find(shard);
  if (last != borders_.end() && border.stamp <= last->second.stamp) return;
  for (const CrowdBorder::Handed& handed : border.handed) {
    const bool is_new = last == borders_.end() || handed.stamp > last->second.stamp;
    if (handed.to == own.index && is_new && !crowd_->find(handed.walker.id))
      crowd_->takeIn(handed.walker);
  }
  const auto found = border.heard.find(own.index);
  if (found != border.heard.end())
    handed_.erase(std::remove_if(handed_.begin(), handed_.end(),
                                 [&](const CrowdBorder::Handed& handed) {
                                   return handed.to == shard && handed.stamp <= found->second;
                                 }),
                  handed_.end());
  borders_[shard] = std::move(border);
}

void CrowdShard::beginTick() {
  std::vector<Walker> seen = left_;
  for (const auto& [shard, border] : borders_)
    seen.insert(seen.end(), border.near.begin(), border.near.end());
  seen.erase(std::remove_if(seen.begin(), seen.end(),
                            [this](const Walker& walker) { return crowd_->find(walker.id); }),
             seen.end());
  // If a person is in two borders, the first counts: those that have just left, then by shard.
  std::stable_sort(seen.begin(), seen.end(),
                   [](const Walker& a, const Walker& b) { return a.id < b.id; });
  seen.erase(std::unique(seen.begin(), seen.end(),
                         [](const Walker& a, const Walker& b) { return a.id == b.id; }),
             seen.end());
  crowd_->setOthers(std::move(seen));
}

void CrowdShard::clear() {
  borders_.clear();
  handed_.clear();
  left_.clear();
  crowd_->setOthers({});
}

}  // namespace vegetation_sim::crowd
