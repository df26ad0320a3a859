// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The people of all shards, which shard 0 joins.
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "nodes/crowd/agent_crowd.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double MOST_AHEAD = 10.0;  // of the people of another shard [s]

// Returns the later part with those people of the earlier one whom it has not.
CrowdPart withOthersOf(const CrowdPart& earlier, CrowdPart later) {
  std::set<std::uint32_t> ids;
  for (const AgentState& agent : later.people.agents) ids.insert(agent.id);
  for (const AgentState& agent : earlier.people.agents)
    if (ids.count(agent.id) == 0) later.people.agents.push_back(agent);
  return later;
}

// Removes those from an old part who have been in another shard since.
void removePeople(CrowdPart& old, const std::map<std::uint32_t, CrowdPart>& fresh,
                  const std::map<std::uint32_t, CrowdPart>& last) {
  std::set<std::uint32_t> ids;
  for (const auto& entry : fresh)
    for (const AgentState& agent : last.at(entry.first).people.agents) ids.insert(agent.id);
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

void AgentCrowd::onPart(const CrowdPart& message) {
  acceptInput("agents/parts", [&] {
    const Nanoseconds stamp = fromMsg(message.people.header.stamp);
    if (message.shard == 0 || message.shard >= options_.shard->count)
      throw InvalidInput("shard = " + std::to_string(message.shard) + " is outside 1 to " +
                         std::to_string(options_.shard->count - 1));
    const TickGrid& grid = clock_.grid();
    if (grid.timeOf(grid.tickAt(stamp)) != stamp)
      throw InvalidInput("stamp = " + std::to_string(stamp) + " ns is not that of a tick");
    const double ahead = secondsBetween(lastStamp(), stamp);
    if (clock_.hasBegun() && ahead > MOST_AHEAD)
      throw InvalidInput("stamp is " + std::to_string(ahead) + " s ahead, allowed are " +
                         std::to_string(MOST_AHEAD) + " s");
    checkFrame(message.people.header.frame_id, options_.frame_id);
    check(message.people.agents);
    check(message.waiting);
    for (const std::uint32_t shard : message.heard)
      if (shard >= options_.shard->count)
        throw InvalidInput("heard = " + std::to_string(shard) + " is outside 0 to " +
                           std::to_string(options_.shard->count - 1));
    if (stamp <= joined_)
      addLatePart(message);
    else
      addPart(message);
  });
}

// The people of a tick are published once those of all shards have come, but for those of silent
// ones and of ones that are late by MOST_PARTS ticks, who stand as they were last.
void AgentCrowd::addPart(const CrowdPart& part) {
  const Nanoseconds stamp = fromMsg(part.people.header.stamp);
  for (std::uint32_t i = 0; i < options_.shard->count; ++i) heard_.emplace(i, stamp);
  heard_[part.shard] = std::max(heard_[part.shard], stamp);
  for (const std::uint32_t shard : part.heard)
    if (shard != options_.shard->index) running_[shard] = std::max(running_[shard], stamp);
  parts_[stamp][part.shard] = part;
  while (!parts_.empty() && hasAll(parts_.begin()->first, parts_.begin()->second)) publishParts();
  if (!clock_.hasBegun())
    while (parts_.size() > MOST_PARTS) parts_.erase(parts_.begin());
}

// The tick of a part was published without it. The next ones wait for its shard again.
void AgentCrowd::addLatePart(const CrowdPart& part) {
  const Nanoseconds stamp = fromMsg(part.people.header.stamp);
  if (stamp <= heard_[part.shard]) return;
  heard_[part.shard] = stamp;
  CrowdPart& last = last_parts_[part.shard];
  last = part.starts ? withOthersOf(last, part) : part;
}

// Each shard sends its parts in order. Only ticks of this shard decide that another is silent. One
// that is known to run has a part too, with those whom it has taken over; it may be late.
bool AgentCrowd::hasAll(Nanoseconds stamp, const Parts& parts) const {
  if (!clock_.hasBegun() || stamp > lastStamp()) return false;
  const Nanoseconds silent = clock_.grid().timeOf(clock_.tick() - MOST_PARTS);
  if (stamp < silent) return true;
  return std::all_of(heard_.begin(), heard_.end(), [&](const auto& shard) {
    if (parts.count(shard.first) > 0 || shard.second > stamp) return true;
    const auto run = running_.find(shard.first);
    return shard.second < silent && (run == running_.end() || run->second < silent);
  });
}

// Returns the earliest part of a shard that has come and waits for its tick. The first ones of a
// shard that returns may be lost while it connects.
const CrowdPart* AgentCrowd::findPart(std::uint32_t shard) const {
  for (const auto& tick : parts_)
    if (const auto found = tick.second.find(shard); found != tick.second.end())
      return &found->second;
  return nullptr;
}

// Publishes the people of the earliest tick.
void AgentCrowd::publishParts() {
  Parts fresh = std::move(parts_.begin()->second);
  joined_ = parts_.begin()->first;
  parts_.erase(parts_.begin());
  Parts last = std::exchange(last_parts_, {});
  Parts before;  // of shards that start: their people of before are shown besides
  for (auto& [owner, part] : fresh) {
    const auto old = last.find(owner);
    if (part.starts && old != last.end()) before[owner] = std::move(old->second);
    last[owner] = std::move(part);
  }
  AgentStates all;
  all.header.stamp = toStamp(joined_);
  all.header.frame_id = options_.frame_id;
  for (const auto& entry : last) all.hash += entry.second.people.hash;
  PeopleLists lists;
  for (const auto& [owner, part] : last)
    if (fresh.count(owner) > 0) lists.push_back(&part.people.agents);
  for (const auto& [owner, part] : last)
    if (fresh.count(owner) > 0) lists.push_back(&part.waiting);
  for (const auto& [owner, part] : last)
    if (fresh.count(owner) == 0) lists.push_back(&part.people.agents);
  for (const auto& entry : before) lists.push_back(&entry.second.people.agents);
  for (std::uint32_t i = 0; i < options_.shard->count; ++i)
    if (const auto later = findPart(i); fresh.count(i) == 0 && later)
      lists.push_back(&later->people.agents);
  all.agents = joinPeople(lists);
  for (auto& [owner, part] : last)
    if (fresh.count(owner) == 0) removePeople(part, fresh, last);
  for (const auto& [owner, part] : before) last[owner] = withOthersOf(part, last[owner]);
  last_parts_ = std::move(last);
  publishJoined(all);
}

void AgentCrowd::publishJoined(const AgentStates& all) {
  state_bytes_ += ros::serialization::serializationLength(all);
  agents_publisher_.publish(all);
  publishNear(all);
  if (view_publisher_.getNumSubscribers() == 0) return;
  std::vector<crowd::Walker> walkers;
  for (const AgentState& agent : all.agents) walkers.push_back(fromMsg(agent));
  sendView(walkers, fromMsg(all.header.stamp));
}

}  // namespace vegetation_sim
