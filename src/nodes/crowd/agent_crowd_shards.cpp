// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The services of the node, which shards answer them, and what shards send to each other.
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

}  // namespace

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
      if (is_here || isHanded(id)) response.ids.push_back(id);
    }
    return std::to_string(response.ids.size()) + " of them are here";
  });
}

// Other shards are sent the same events for those who may have crossed the border.
bool AgentCrowd::isForThisShard(const CrowdEvent& event) {
  if (event.kind != CrowdEvent::REMOVE && event.kind != CrowdEvent::GOAL) return true;
  if (crowd_.find(event.id)) return true;
  if (event.kind == CrowdEvent::REMOVE) shard_->removeWaiting(event.id);
  return false;
}

bool AgentCrowd::isHanded(std::uint32_t id) const {
  const auto& all = shard_->handed();
  return std::any_of(all.begin(), all.end(),
                     [id](const auto& handed) { return handed.walker.id == id; });
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
  for (auto border = taken.rbegin(); border != taken.rend(); ++border) {
    Nanoseconds& newest = heard_borders_[border->shard];
    newest = std::max(newest, fromMsg(border->header.stamp));
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
  shard_->hear(found->shard, std::move(border));
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
  return a.bytes();
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
    if (stamp <= joined_)
      addLatePart(message);
    else
      addPart(message);
  });
}

// The people of a tick are published once those of all shards have come, but for those of silent
// ones, who stand as they were last.
void AgentCrowd::addPart(const CrowdPart& part) {
  const Nanoseconds stamp = fromMsg(part.people.header.stamp);
  for (std::uint32_t i = 0; i < options_.shard->count; ++i) heard_.emplace(i, stamp);
  heard_[part.shard] = std::max(heard_[part.shard], stamp);
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
// whose border has come has a part too, with those whom it has taken over.
bool AgentCrowd::hasAll(Nanoseconds stamp, const Parts& parts) const {
  if (!clock_.hasBegun() || stamp > lastStamp()) return false;
  const Nanoseconds silent = clock_.grid().timeOf(clock_.tick() - MOST_PARTS);
  return std::all_of(heard_.begin(), heard_.end(), [&](const auto& shard) {
    if (parts.count(shard.first) > 0 || shard.second > stamp) return true;
    const auto border = heard_borders_.find(shard.first);
    return shard.second < silent && (border == heard_borders_.end() || border->second < silent);
  });
}

// Publishes the people of the earliest tick.
void AgentCrowd::publishParts() {
  Parts fresh = std::move(parts_.begin()->second);
  joined_ = parts_.begin()->first;
  parts_.erase(parts_.begin());
  AgentStates all;
  all.header.stamp = toStamp(joined_);
  all.header.frame_id = options_.frame_id;
  const auto add = [&all](const std::vector<AgentState>& people) {
    all.agents.insert(all.agents.end(), people.begin(), people.end());
  };
  Parts last = std::exchange(last_parts_, {});
  Parts before;  // of shards that start: their people of before are shown besides
  for (auto& [owner, part] : fresh) {
    const auto old = last.find(owner);
    if (part.starts && old != last.end()) before[owner] = std::move(old->second);
    last[owner] = std::move(part);
  }
  for (const auto& entry : last) all.hash += entry.second.people.hash;
  // A person in several lists is taken from the first.
  for (const auto& entry : last)
    if (fresh.count(entry.first) > 0) add(entry.second.people.agents);
  for (const auto& entry : last)
    if (fresh.count(entry.first) > 0) add(entry.second.waiting);
  for (const auto& entry : last)
    if (fresh.count(entry.first) == 0) add(entry.second.people.agents);
  for (const auto& entry : before) add(entry.second.people.agents);
  const auto is_before = [](const AgentState& a, const AgentState& b) { return a.id < b.id; };
  std::stable_sort(all.agents.begin(), all.agents.end(), is_before);
  const auto is_same = [](const AgentState& a, const AgentState& b) { return a.id == b.id; };
  all.agents.erase(std::unique(all.agents.begin(), all.agents.end(), is_same), all.agents.end());
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
