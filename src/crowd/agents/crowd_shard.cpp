// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/agents/crowd_shard.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace vegetation_sim::crowd {
namespace {

constexpr double MOST_RADIUS = 1.0;  // of a person [m]

Walker makeStanding(Walker walker) {
  walker.velocity = {};
  walker.turn_rate = 0.0;
  return walker;
}

}  // namespace

CrowdBorder CrowdShard::begin(Start start) {
  borders_.clear();
  handed_.clear();
  left_.clear();
  waiting_.clear();
  removed_.clear();
  start_ = crowd_->takeOutside(owners_);
  crowd_->setOthers({});
  fresh_ = start == Start::FRESH;
  if (fresh_) {
    begun_.reset();
    known_.clear();
  }
  starts_ = false;
  asked_ = 0;
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
  if (starts_ && asked_ == 0) asked_ = last_;
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
  asked_ = 0;
  handed_.clear();
  left_.clear();
  while (!crowd_->walkers().empty()) crowd_->remove(crowd_->walkers().back().id);
  start_.clear();
}

std::size_t CrowdShard::hear(std::uint32_t shard, CrowdBorder border) {
  const Shard& own = owners_.shard();
  if (shard >= own.count || shard == own.index)
    throw InvalidInput("border: shard = " + std::to_string(shard) + " is no other shard of the " +
                       std::to_string(own.count) + " than this one, " + std::to_string(own.index));
  const auto known = borders_.find(shard);
  if (known != borders_.end() && border.stamp <= known->second.stamp) return 0;
  const bool is_younger = fresh_ || border.begun < begun_.value_or(0);
  const bool is_first = border.stamp > 0 && known_.insert(shard).second;
  if (is_first && is_younger && !starts_) removeAll();
  if (isStarting() && border.run > run_) {  // people from before the reset are void
    run_ = border.run;
    if (starts_) removeAll();
  }
  if (border.run < run_) return 0;
  forgetTaken(shard, border);
  const std::size_t lost = takeIn(shard, border);
  borders_[shard] = std::move(border);
  return lost;
}

// Forgets those on the way to a shard that has heard of them.
void CrowdShard::forgetTaken(std::uint32_t shard, const CrowdBorder& border) {
  const auto heard = border.heard.find(owners_.shard().index);
  if (heard == border.heard.end()) return;
  handed_.erase(std::remove_if(handed_.begin(), handed_.end(),
                               [&](const CrowdBorder::Handed& handed) {
                                 return handed.to == shard && handed.stamp <= heard->second;
                               }),
                handed_.end());
}

// A shard that has started later and has not heard this one yet may have people who live elsewhere.
// It removes them once it does. Those on the way are in the state of this shard as well.
std::size_t CrowdShard::takeIn(std::uint32_t shard, const CrowdBorder& border) {
  const std::uint32_t own = owners_.shard().index;
  if (begun_ && border.begun > *begun_ && border.heard.count(own) == 0) return 0;
  std::size_t lost = 0;
  const auto known = borders_.find(shard);
  for (const CrowdBorder::Handed& handed : border.handed) {
    const bool is_new = known == borders_.end() || handed.stamp > known->second.stamp;
    if (handed.to != own || !is_new || crowd_->find(handed.walker.id)) continue;
    // Somebody who comes back before the shard between has said so is no longer on the way to it.
    const auto on_way = findHanded(handed.walker.id);
    if (on_way != handed_.end() && on_way->stamp >= handed.stamp) continue;
    if (on_way != handed_.end()) handed_.erase(on_way);
    if (crowd_->walkers().size() + handed_.size() < MOST_WALKERS)
      crowd_->takeIn(handed.walker);
    else
      ++lost;
  }
  return lost;
}

// Whether a border lists the people of its shard as they were after this one had asked.
bool CrowdShard::hasAnswered(std::uint32_t shard) const {
  const auto found = borders_.find(shard);
  if (found == borders_.end() || found->second.stamp < last_ || !found->second.lists) return false;
  const auto heard = found->second.heard.find(owners_.shard().index);
  return heard != found->second.heard.end() && heard->second >= asked_;
}

std::optional<std::size_t> CrowdShard::spawnMissing(const std::vector<Spawn>& spawns) {
  if (!starts_ || asked_ == 0) return {};
  const bool is_patient = secondsBetween(asked_, last_) < LONGEST_START;
  std::set<std::uint32_t> elsewhere, starters;
  bool knows_all = true;
  for (std::uint32_t i = 0; i < owners_.shard().count; ++i) {
    if (i == owners_.shard().index) continue;
    if (!hasAnswered(i)) {
      if (is_patient) return {};
      knows_all = false;
    }
    const auto found = borders_.find(i);
    if (found == borders_.end()) continue;
    elsewhere.insert(found->second.ids.begin(), found->second.ids.end());
    if (found->second.starts) starters.insert(i);
  }
  starts_ = false;
  // The first of the shards that start has those whose region belongs to one that runs.
  const bool is_first = starters.empty() || owners_.shard().index < *starters.begin();
  std::size_t out = 0;
  for (std::size_t i = 0; i < spawns.size(); ++i) {
    const auto id = static_cast<std::uint32_t>(i);
    if (elsewhere.count(id) > 0 || has(id)) continue;
    const std::uint32_t owner = owners_.ownerAt(spawns[i].position);
    const bool is_own = owner == owners_.shard().index;
    if (!is_own && !(knows_all && is_first && starters.count(owner) == 0)) continue;
    crowd_->spawn(spawns[i], id);
    ++out;
  }
  if (!elsewhere.empty()) crowd_->keepIdsFree(*elsewhere.rbegin());
  return out;
}

void CrowdShard::beginTick() {
  for (auto id = removed_.begin(); id != removed_.end();)
    id = findHanded(*id) == handed_.end() ? removed_.erase(id) : std::next(id);
  std::vector<Walker> seen = left_;
  for (const auto& [shard, border] : borders_)
    seen.insert(seen.end(), border.near.begin(), border.near.end());
  for (const Walker& walker : start_)
    if (borders_.count(owners_.ownerAt(walker.position)) == 0) seen.push_back(walker);
  waiting_.clear();
  for (const CrowdBorder::Handed& handed : handed_)
    if (waits(handed)) waiting_.push_back(makeStanding(handed.walker));
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

std::vector<Walker> CrowdShard::standing() const {
  std::vector<Walker> out;
  for (const CrowdBorder::Handed& handed : handed_)
    if (removed_.count(handed.walker.id) == 0) out.push_back(makeStanding(handed.walker));
  return out;
}

// A shard that runs takes people in at the tick after that in which they have crossed the border,
// and its next border says so.
bool CrowdShard::waits(const CrowdBorder::Handed& handed) const {
  const auto found = borders_.find(handed.to);
  const bool runs = found != borders_.end() && found->second.stamp >= handed.stamp;
  return !runs || handed.stamp < last_;
}

std::vector<CrowdBorder::Handed>::const_iterator CrowdShard::findHanded(std::uint32_t id) const {
  return std::find_if(handed_.begin(), handed_.end(),
                      [id](const auto& handed) { return handed.walker.id == id; });
}

void CrowdShard::removeHanded(std::uint32_t id) {
  const auto found = findHanded(id);
  if (found == handed_.end()) return;
  if (waits(*found))
    handed_.erase(found);
  else
    removed_.insert(id);
}

bool CrowdShard::has(std::uint32_t id) const {
  return crowd_->find(id) || isHanded(id);
}

bool CrowdShard::mayHave(std::uint32_t id) const {
  const auto is_it = [id](const Walker& walker) { return walker.id == id; };
  return has(id) || std::any_of(borders_.begin(), borders_.end(), [&](const auto& entry) {
           const std::vector<Walker>& near = entry.second.near;
           return std::any_of(near.begin(), near.end(), is_it);
         });
}

}  // namespace vegetation_sim::crowd
