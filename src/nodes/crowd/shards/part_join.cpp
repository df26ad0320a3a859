// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/crowd/shards/part_join.h"

#include <algorithm>
#include <utility>

#include "ros/conversions/crowd_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_TICKS = 15;  // that wait for the first tick of this node

// Returns the later part with those people of the earlier one whom it has not.
CrowdPart withOthersOf(const CrowdPart& earlier, CrowdPart later) {
  std::set<std::uint32_t> ids;
  for (const AgentState& agent : later.people.agents) ids.insert(agent.id);
  for (const AgentState& agent : earlier.people.agents)
    if (ids.count(agent.id) == 0) later.people.agents.push_back(agent);
  return later;
}

// Removes those from an old part who have been in another shard since.
void removePeople(CrowdPart& old, const std::set<std::uint32_t>& fresh,
                  const std::map<std::uint32_t, CrowdPart>& last) {
  std::set<std::uint32_t> ids;
  for (const std::uint32_t shard : fresh)
    for (const AgentState& agent : last.at(shard).people.agents) ids.insert(agent.id);
  auto& people = old.people.agents;
  people.erase(std::remove_if(people.begin(), people.end(),
                              [&](const AgentState& agent) { return ids.count(agent.id) > 0; }),
               people.end());
}

using PeopleLists = std::vector<const std::vector<AgentState>*>;

// Returns the people of all lists by rising id; one in several lists as in the first.
std::vector<AgentState> joinPeople(const PeopleLists& lists) {
  std::vector<AgentState> out;
  for (const std::vector<AgentState>* list : lists)
    out.insert(out.end(), list->begin(), list->end());
  std::stable_sort(out.begin(), out.end(),
                   [](const AgentState& a, const AgentState& b) { return a.id < b.id; });
  out.erase(std::unique(out.begin(), out.end(),
                        [](const AgentState& a, const AgentState& b) { return a.id == b.id; }),
            out.end());
  return out;
}

}  // namespace

void check(const CrowdPart& part, std::uint32_t shards) {
  if (part.shard == 0 || part.shard >= shards)
    throw InvalidInput("shard = " + std::to_string(part.shard) + " is outside 1 to " +
                       std::to_string(shards - 1));
  check(part.people.agents);
  check(part.waiting);
  for (const std::uint32_t shard : part.heard)
    if (shard >= shards)
      throw InvalidInput("heard = " + std::to_string(shard) + " is outside 0 to " +
                         std::to_string(shards - 1));
}

void PartJoin::add(const CrowdPart& part) {
  const Nanoseconds stamp = fromMsg(part.people.header.stamp);
  if (isFromBeforeJump(part.shard, stamp)) return;
  if (stamp <= joined_) {
    addLate(part);
    return;
  }
  for (std::uint32_t shard = 0; shard < shards_; ++shard) heard_.emplace(shard, stamp);
  heard_[part.shard] = std::max(heard_[part.shard], stamp);
  for (const std::uint32_t shard : part.heard)
    if (shard != own_) running_[shard] = std::max(running_[shard], stamp);
  waiting_[stamp][part.shard] = part;
  if (last_tick_ == 0)
    while (waiting_.size() > MOST_TICKS) waiting_.erase(waiting_.begin());
}

// A part that this node had not received before it saw the jump is later than those it had.
bool PartJoin::isFromBeforeJump(std::uint32_t shard, Nanoseconds stamp) {
  const auto before = before_jump_.find(shard);
  if (before == before_jump_.end()) return false;
  if (stamp > before->second && last_tick_ <= before->second) return true;
  before_jump_.erase(before);
  return false;
}

// The people of its tick were returned without it. The next ones wait for its shard again.
void PartJoin::addLate(const CrowdPart& part) {
  const Nanoseconds stamp = fromMsg(part.people.header.stamp);
  if (stamp <= heard_[part.shard]) return;
  ++late_;
  heard_[part.shard] = stamp;
  CrowdPart& last = last_[part.shard];
  last = part.starts ? withOthersOf(last, part) : part;
}

// Only ticks of this node decide that another shard is silent. One that is known to run has a part
// too, with those whom it has taken over; it may be late.
bool PartJoin::hasAll(Nanoseconds stamp, const Parts& parts) const {
  if (last_tick_ == 0 || stamp > last_tick_) return false;
  const Nanoseconds silent = last_tick_ - fromSeconds(LONGEST_WAIT);
  if (stamp < silent) return true;
  return std::all_of(heard_.begin(), heard_.end(), [&](const auto& shard) {
    if (parts.count(shard.first) > 0 || shard.second > stamp) return true;
    const auto run = running_.find(shard.first);
    return shard.second < silent && (run == running_.end() || run->second < silent);
  });
}

// Returns the earliest part of a shard that has come and waits for its tick. The first ones of a
// shard that returns may be lost while it connects.
const CrowdPart* PartJoin::findPart(std::uint32_t shard) const {
  for (const auto& tick : waiting_)
    if (const auto found = tick.second.find(shard); found != tick.second.end())
      return &found->second;
  return nullptr;
}

// Of one who is in several lists, the first is right. The people of shards without a part for this
// tick stand as they were last, or come from a later part.
std::vector<AgentState> PartJoin::peopleOf(const std::set<std::uint32_t>& fresh,
                                           const Parts& before) const {
  PeopleLists lists;
  for (const std::uint32_t shard : fresh) lists.push_back(&last_.at(shard).people.agents);
  for (const std::uint32_t shard : fresh) lists.push_back(&last_.at(shard).waiting);
  for (const auto& [shard, part] : last_)
    if (fresh.count(shard) == 0) lists.push_back(&part.people.agents);
  for (const auto& entry : before) lists.push_back(&entry.second.people.agents);
  for (std::uint32_t shard = 0; shard < shards_; ++shard)
    if (const CrowdPart* later = findPart(shard); fresh.count(shard) == 0 && later)
      lists.push_back(&later->people.agents);
  return joinPeople(lists);
}

std::optional<JoinedPeople> PartJoin::take() {
  if (waiting_.empty() || !hasAll(waiting_.begin()->first, waiting_.begin()->second)) return {};
  JoinedPeople out;
  out.stamp = joined_ = waiting_.begin()->first;
  Parts parts = std::move(waiting_.begin()->second);
  waiting_.erase(waiting_.begin());
  std::set<std::uint32_t> fresh;
  Parts before;  // of shards that start: their people of before are shown besides
  for (auto& [shard, part] : parts) {
    fresh.insert(shard);
    const auto last = last_.find(shard);
    if (part.starts && last != last_.end()) before[shard] = std::move(last->second);
    last_[shard] = std::move(part);
  }
  for (const auto& entry : last_) out.hash += entry.second.people.hash;
  out.agents = peopleOf(fresh, before);
  for (auto& [shard, part] : last_)
    if (fresh.count(shard) == 0) removePeople(part, fresh, last_);
  for (const auto& [shard, part] : before) last_[shard] = withOthersOf(part, last_[shard]);
  return out;
}

void PartJoin::jumpBack() {
  for (const auto& [shard, stamp] : heard_)
    if (shard != own_) before_jump_[shard] = std::max(before_jump_[shard], stamp);
  waiting_.clear();
  heard_.clear();
  running_.clear();
  last_.clear();
  last_tick_ = joined_ = 0;
}

}  // namespace vegetation_sim
