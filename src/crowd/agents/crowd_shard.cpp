// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/agents/crowd_shard.h"

#include <algorithm>
#include <set>
#include <utility>

namespace vegetation_sim::crowd {
namespace {

constexpr double MOST_RADIUS = 1.0;  // of a person [m]

}  // namespace

CrowdBorder CrowdShard::begin(Start start) {
  borders_.clear();
  handed_.clear();
  left_.clear();
  waiting_.clear();
  start_ = crowd_->takeOutside(owners_);
  crowd_->setOthers({});
  fresh_ = start == Start::FRESH;
  if (fresh_) {
    begun_.reset();
    known_.clear();
  }
  starts_ = false;
  start_stamp_ = 0;
  std::vector<Walker> others = start_;
  CrowdBorder out = endTick();
  start_ = std::move(others);
  return out;
}

CrowdBorder CrowdShard::endTick() {
  CrowdBorder out;
  out.stamp = last_ = crowd_->snapshot().stamp;
  if (!begun_ && last_ > 0) begun_ = last_;
  out.begun = begun_.value_or(0);
  const double margin = crowd_->snapshot().settings.sensor_range + 2.0 * MOST_RADIUS;
  for (const Walker& walker : crowd_->walkers())
    if (owners_.isNearOthers(walker.position, margin)) out.near.push_back(walker);
  left_ = crowd_->takeOutside(owners_);
  start_.clear();
  for (const Walker& walker : left_)
    handed_.push_back({owners_.ownerAt(walker.position), out.stamp, walker});
  out.handed = handed_;
  out.run = run_;
  out.starts = starts_;
  for (const auto& [shard, border] : borders_) {
    out.heard[shard] = border.stamp;
    out.lists = out.lists || border.starts;
  }
  if (!out.lists) return out;
  for (const Walker& walker : crowd_->walkers()) out.ids.push_back(walker.id);
  for (const CrowdBorder::Handed& handed : handed_) out.ids.push_back(handed.walker.id);
  return out;
}

void CrowdShard::startBesideOthers() {
  if (fresh_ && !starts_) removeAll();
}

void CrowdShard::removeAll() {
  starts_ = true;
  start_stamp_ = 0;
  handed_.clear();
  left_.clear();
  while (!crowd_->walkers().empty()) crowd_->remove(crowd_->walkers().back().id);
  start_.clear();
}

void CrowdShard::hear(std::uint32_t shard, CrowdBorder border) {
  const Shard& own = owners_.shard();
  if (shard >= own.count || shard == own.index)
    throw InvalidInput("border: shard = " + std::to_string(shard) + " is no other shard of the " +
                       std::to_string(own.count) + " than this one, " + std::to_string(own.index));
  const auto last = borders_.find(shard);
  if (last != borders_.end() && border.stamp <= last->second.stamp) return;
  const bool is_younger = fresh_ || border.begun < begun_.value_or(0);
  if (border.stamp > 0 && is_younger && known_.insert(shard).second && !starts_) removeAll();
  if (isStarting()) run_ = std::max(run_, border.run);
  if (border.run < run_) return;
  const auto found = border.heard.find(own.index);
  if (found != border.heard.end())
    handed_.erase(std::remove_if(handed_.begin(), handed_.end(),
                                 [&](const CrowdBorder::Handed& handed) {
                                   return handed.to == shard && handed.stamp <= found->second;
                                 }),
                  handed_.end());
  for (const CrowdBorder::Handed& handed : border.handed) {
    const bool is_new = last == borders_.end() || handed.stamp > last->second.stamp;
    if (handed.to == own.index && is_new && !has(handed.walker.id)) crowd_->takeIn(handed.walker);
  }
  borders_[shard] = std::move(border);
}

std::optional<std::size_t> CrowdShard::spawnMissing(const std::vector<Spawn>& spawns) {
  if (!starts_ || fresh_) return {};
  if (start_stamp_ == 0) start_stamp_ = last_;
  const bool is_patient = secondsBetween(start_stamp_, last_) < LONGEST_START;
  std::set<std::uint32_t> elsewhere;
  bool knows_all = true;
  for (std::uint32_t i = 0; i < owners_.shard().count; ++i) {
    if (i == owners_.shard().index) continue;
    const auto found = borders_.find(i);
    const bool is_heard = found != borders_.end() && found->second.stamp >= last_;
    if (!is_heard && is_patient) return {};
    const bool runs = is_heard && !found->second.starts;
    knows_all = knows_all && runs;
    if (runs && !found->second.lists) return {};
    if (found == borders_.end()) continue;
    elsewhere.insert(found->second.ids.begin(), found->second.ids.end());
  }
  starts_ = false;
  std::size_t out = 0;
  for (std::size_t i = 0; i < spawns.size(); ++i) {
    const auto id = static_cast<std::uint32_t>(i);
    if (elsewhere.count(id) > 0 || crowd_->find(id)) continue;
    if (!knows_all && !owners_.owns(spawns[i].position)) continue;
    crowd_->spawn(spawns[i], id);
    ++out;
  }
  if (!elsewhere.empty()) crowd_->keepIdsFree(*elsewhere.rbegin());
  return out;
}

void CrowdShard::beginTick() {
  std::vector<Walker> seen = left_;
  for (const auto& [shard, border] : borders_)
    seen.insert(seen.end(), border.near.begin(), border.near.end());
  for (const Walker& walker : start_)
    if (borders_.count(owners_.ownerAt(walker.position)) == 0) seen.push_back(walker);
  waiting_.clear();
  for (const CrowdBorder::Handed& handed : handed_) {
    if (!waits(handed)) continue;
    waiting_.push_back(handed.walker);
    waiting_.back().velocity = {};
    waiting_.back().turn_rate = 0.0;
  }
  seen.insert(seen.end(), waiting_.begin(), waiting_.end());
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
  fresh_ = false;
}

// A shard that runs takes people in at the tick after that in which they have crossed the border,
// and its next border says so.
bool CrowdShard::waits(const CrowdBorder::Handed& handed) const {
  const auto found = borders_.find(handed.to);
  const bool runs = found != borders_.end() && found->second.stamp >= handed.stamp;
  return !runs || handed.stamp < last_;
}

bool CrowdShard::removeWaiting(std::uint32_t id) {
  const auto found = std::find_if(handed_.begin(), handed_.end(), [&](const auto& handed) {
    return handed.walker.id == id && waits(handed);
  });
  if (found == handed_.end()) return false;
  handed_.erase(found);
  return true;
}

bool CrowdShard::has(std::uint32_t id) const {
  const auto is_handed = [id](const auto& handed) { return handed.walker.id == id; };
  return crowd_->find(id) || std::any_of(handed_.begin(), handed_.end(), is_handed);
}

bool CrowdShard::mayHave(std::uint32_t id) const {
  const auto is_it = [id](const Walker& walker) { return walker.id == id; };
  return has(id) || std::any_of(borders_.begin(), borders_.end(), [&](const auto& entry) {
           const std::vector<Walker>& near = entry.second.near;
           return std::any_of(near.begin(), near.end(), is_it);
         });
}

}  // namespace vegetation_sim::crowd
