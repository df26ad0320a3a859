// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The services of the node, which shards answer them, and the borders that shards send to each
// other.
#include <algorithm>
#include <iterator>
#include <numeric>
#include <set>
#include <utility>

#include "core/archive/archive.h"
#include "nodes/crowd/agent_crowd.h"
#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {

void AgentCrowd::connectServices() {
  serveShared(
      "spawn", &AgentCrowd::onSpawn,
      [this](const SpawnAgents::Request& request) { return ownersOfPlace(request); },
      Repeat::FORBIDDEN);
  serveShared(
      "remove", &AgentCrowd::onRemove,
      [this](RemoveAgents::Request& request) {
        FindAgents::Request find;
        find.ids = request.ids;
        find.all = request.all;
        const std::vector<std::uint32_t> owners = findOwners(find);
        request.ids = find.ids;
        request.all = find.ids.empty();
        return owners;
      },
      Repeat::FORBIDDEN, joinReplies<RemoveAgents::Response>);
  serveShared(
      "set_goal", &AgentCrowd::onSetGoal,
      [this](const SetAgentGoal::Request& request) {
        FindAgents::Request find;
        find.ids = request.ids;
        find.has_goal = !request.wander;
        find.goal = request.goal;
        return findOwners(find);
      },
      Repeat::ALLOWED, joinReplies<SetAgentGoal::Response>);
  if (shards()) serve("owned/find_agents", &AgentCrowd::onFind);
}

// A request is refused as a whole or carried out for all of its walkers, as by one node. Those who
// cross a border meanwhile are found by all shards that may have them.
std::vector<std::uint32_t> AgentCrowd::findOwners(FindAgents::Request& request) {
  std::vector<std::uint32_t> all(options_.shard->count), out;
  std::iota(all.begin(), all.end(), 0U);
  const auto replies = askShards<FindAgents::Request, FindAgents::Response>(
      "find_agents", all, request, Repeat::ALLOWED,
      [this](FindAgents::Request& own, FindAgents::Response& response) { onFind(own, response); });
  std::set<std::uint32_t> found;
  const FindAgents::Response* silent = nullptr;
  for (const auto& [shard, response] : replies) {
    if (response.success) {
      out.push_back(shard);
      found.insert(response.ids.begin(), response.ids.end());
    } else if (response.error_code == ErrorCode::NOT_AVAILABLE) {
      silent = &response;
    } else {
      throw InvalidInput(response.message, static_cast<FaultCode>(response.error_code));
    }
  }
  if (request.all) request.ids.assign(found.begin(), found.end());
  Faults faults;
  if (!request.all || !found.empty()) checkNumber(request.ids, faults);
  faults.throwIfAny();
  for (const std::uint32_t id : request.ids)
    if (found.count(id) == 0) addUnknown(id, faults);
  if (silent && (request.all || !faults.empty()))
    throw InvalidInput(silent->message, FaultCode::NOT_AVAILABLE);
  faults.throwIfAny();
  return out;
}

bool AgentCrowd::onFind(FindAgents::Request& request, FindAgents::Response& response) {
  return answer(response, [&]() -> std::string {
    refuseInReplay();
    for (const crowd::Walker& walker : shard_->waiting())
      if (request.all ||
          std::find(request.ids.begin(), request.ids.end(), walker.id) != request.ids.end())
        throw InvalidInput(
            "walker " + std::to_string(walker.id) + " waits for " +
                describeShard(shard_->owners().ownerAt(walker.position), options_.shard->count) +
                ", which is silent",
            FaultCode::NOT_AVAILABLE);
    std::vector<std::uint32_t> ids = request.ids;
    if (request.all) ids = allIds();
    crowd::Point goal;
    if (request.has_goal)
      goal = placeInWorld(request.goal.point, poseOf(request.goal.header.frame_id));
    for (const std::uint32_t id : ids) {
      const bool is_here = crowd_.find(id) != nullptr;
      if (is_here && request.has_goal) crowd_.checkGoal(id, goal);
      if (is_here || shard_->isHanded(id)) response.ids.push_back(id);
    }
    return std::to_string(response.ids.size()) + " of them are here";
  });
}

// Other shards are sent the same events for those who may have crossed the border.
bool AgentCrowd::isForThisShard(const CrowdEvent& event) {
  if (event.kind != CrowdEvent::REMOVE && event.kind != CrowdEvent::GOAL) return true;
  if (crowd_.find(event.id)) return true;
  if (event.kind == CrowdEvent::REMOVE) shard_->removeHanded(event.id);
  return false;
}

// Those on the way to another shard are among them.
std::vector<std::uint32_t> AgentCrowd::allIds() const {
  std::vector<std::uint32_t> out;
  for (const crowd::Walker& walker : crowd_.walkers()) out.push_back(walker.id);
  if (!isPart()) return out;
  for (const auto& handed : shard_->handed()) out.push_back(handed.walker.id);
  return out;
}

std::vector<std::uint32_t> AgentCrowd::ownersOfPlace(const SpawnAgents::Request& request) {
  std::uint32_t owner = 0;
  shards()->runOnNode([&] {
    const geometry_msgs::Point& point = request.like.position;
    const Vec3 place = transformed(poseOf(request.header.frame_id), Vec3(point.x, point.y, 0.0));
    owner = shard_->owners().ownerAt({place.x(), place.y()});
  });
  return {owner};
}

// Ids of requests differ between shards, and from those of the scenario.
std::uint32_t AgentCrowd::takeId() {
  const std::uint32_t out =
      shard_ ? nextIdOf(*options_.shard, std::max<std::uint32_t>(1, next_id_)) : next_id_;
  next_id_ = out + 1;
  return out;
}

// Borders come first, by rising shard: requests are for those who are here then.
void AgentCrowd::hearBorders(Nanoseconds stamp) {
  if (!inbox_) return;
  const crowd::CrowdSnapshot& state = crowd_.snapshot();
  const std::vector<CrowdBorder> taken = inbox_->take(state.begun ? state.stamp : 0, stamp);
  if (inbox_->isAnyAhead() || isAnyRunningShardSilent()) shard_->startBesideOthers();
  is_first_tick_ = false;
  heard_now_.clear();
  for (auto border = taken.rbegin(); border != taken.rend(); ++border) {
    heard_now_.push_back(border->shard);
    Hash hash;
    hash.add(bytesOf(*border));
    borders_.keep(hash.value(), *border);
    CrowdEvent event;
    event.kind = BORDER;
    event.input_hash = hash.value();
    inputs_.addFirst(event);
  }
}

// Whether, at the first tick, the borders of a shard that answers requests have not come in time.
bool AgentCrowd::isAnyRunningShardSilent() {
  if (!is_first_tick_) return false;
  for (std::uint32_t i = 0; i < options_.shard->count; ++i)
    if (shards()->registry().isOpen(i) && !inbox_->hasSent(i)) return true;
  return false;
}

void AgentCrowd::applyBorder(std::uint64_t hash) {
  const CrowdBorder* found = borders_.find(hash);
  if (!found || !shard_)
    throw InvalidInput("input_hash = " + std::to_string(hash) + " matches no border received");
  auto [border, walked] = readBorder({found->border.begin(), found->border.end()});
  if (shard_->isResetBy(border)) {
    shard_->setRun(border.run);
    resetCrowd(crowd::CrowdShard::Start::RESET);
  }
  for (auto last = walked.begin(); last != walked.end();)
    last = crowd_.find(last->first) ? walked.erase(last) : std::next(last);
  if (const std::size_t lost = shard_->hear(found->shard, std::move(border)))
    refusals_.add("agents/border", std::to_string(lost) + " people of " +
                                       describeShard(found->shard, options_.shard->count) +
                                       ": allowed are " + std::to_string(crowd::MOST_WALKERS) +
                                       " in a shard");
  for (const auto& [id, last] : walked)
    if (crowd_.find(id)) trodden_.insert_or_assign(id, last);
}

// With those who have crossed the border, where they have trodden last: their tracks go on.
std::string AgentCrowd::archiveBorder(const crowd::CrowdBorder& border) const {
  std::string people = crowd::archiveBorder(border);
  Walked walked;
  for (const auto& handed : border.handed)
    if (const auto last = trodden_.find(handed.walker.id); last != trodden_.end())
      walked.insert(*last);
  Archive a;
  a.text("border", people, LARGEST_SNAPSHOT);
  archive(a, walked);
  return a.takeBytes();
}

std::pair<crowd::CrowdBorder, AgentCrowd::Walked> AgentCrowd::readBorder(std::string bytes) {
  Archive a = Archive::reading(std::move(bytes));
  std::string people;
  Walked walked;
  a.text("border", people, LARGEST_SNAPSHOT);
  archive(a, walked);
  a.finish();
  return {crowd::readBorder(std::move(people)), std::move(walked)};
}

void AgentCrowd::beginTickOfShard() {
  if (!shard_) return;
  if (const auto spawned = shard_->spawnMissing(options_.scene.crowd.spawns))
    ROS_INFO("%s: other shards run already; %zu people whom none of them has begin at their starts",
             name_.c_str(), *spawned);
  shard_->beginTick();
}

void AgentCrowd::endTickOfShard() {
  if (!shard_) return;
  keepBorder(shard_->endTick());
  publishBorder();
}

void AgentCrowd::keepBorder(const crowd::CrowdBorder& after_tick) {
  const Nanoseconds stamp = after_tick.stamp;
  SentBorder border{stamp, archiveBorder(after_tick)};
  previous_border_ = stamp > border_.stamp ? std::move(border_) : SentBorder();
  border_ = std::move(border);
}

void AgentCrowd::publishBorder() {
  if (!inbox_) return;
  CrowdBorder message;
  message.header.stamp = toStamp(border_.stamp);
  message.header.frame_id = options_.frame_id;
  message.shard = options_.shard->index;
  message.shards = options_.shard->count;
  message.border.assign(border_.bytes.begin(), border_.bytes.end());
  message.previous_stamp = toStamp(previous_border_.stamp);
  message.previous_border.assign(previous_border_.bytes.begin(), previous_border_.bytes.end());
  border_publisher_.publish(message);
}

}  // namespace vegetation_sim
