// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The services of the node, which shards answer them, and what shards send to each other.
#include "nodes/crowd/agent_crowd.h"
#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {
namespace {

// Any response that is no refusal. A shard that does not answer may have the people.
template <class Response>
Response takeAny(const std::vector<ShardReply<Response>>& replies) {
  const ShardReply<Response>* out = &replies.front();
  for (const ShardReply<Response>& reply : replies) {
    if (reply.response.success) return reply.response;
    if (reply.response.error_code == ErrorCode::NOT_AVAILABLE) out = &reply;
  }
  return out->response;
}

}  // namespace

void AgentCrowd::connectServices() {
  serveShared(
      "spawn", &AgentCrowd::onSpawn,
      [this](const SpawnAgents::Request& request) { return ownersOfPlace(request); },
      Repeat::FORBIDDEN);
  serveShared("remove", &AgentCrowd::onRemove, toAllShards<RemoveAgents::Request>(),
              Repeat::FORBIDDEN, takeAny<RemoveAgents::Response>);
  serveShared("set_goal", &AgentCrowd::onSetGoal, toAllShards<SetAgentGoal::Request>(),
              Repeat::ALLOWED, takeAny<SetAgentGoal::Response>);
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

void AgentCrowd::hearBorders(Nanoseconds stamp) {
  if (!inbox_) return;
  const crowd::CrowdSnapshot& state = crowd_.snapshot();
  for (const CrowdBorder& border : inbox_->take(state.begun ? state.stamp : 0, stamp)) {
    Hash hash;
    hash.add(bytesOf(border));
    borders_.keep(hash.value(), border);
    CrowdEvent event;
    event.kind = BORDER;
    event.input_hash = hash.value();
    inputs_.add(event);
  }
}

void AgentCrowd::applyBorder(std::uint64_t hash) {
  const CrowdBorder* found = borders_.find(hash);
  if (!found || !shard_)
    throw InvalidInput("input_hash = " + std::to_string(hash) + " matches no border received");
  shard_->hear(found->shard, crowd::readBorder({found->border.begin(), found->border.end()}));
}

void AgentCrowd::endTickOfShard() {
  if (!shard_) return;
  keepBorder();
  publishBorder();
}

void AgentCrowd::keepBorder() {
  const Nanoseconds stamp = crowd_.snapshot().stamp;
  SentBorder border{stamp, crowd::archiveBorder(shard_->endTick())};
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
    if (stamp <= joined_) return;  // its tick was published without it
    addPart(stamp, message.shard, message.people);
  });
}

// The people of a tick are published once those of all shards have come. Earlier ticks are then
// past: each shard sends its own in order. Those of a silent shard stand as they were last.
void AgentCrowd::addPart(Nanoseconds stamp, std::uint32_t shard, const AgentStates& people) {
  const auto tick = parts_.emplace(stamp, Parts()).first;
  tick->second[shard] = people;
  if (tick->second.size() == options_.shard->count) {
    parts_.erase(parts_.begin(), tick);
  } else if (parts_.size() <= MOST_PARTS) {
    return;
  }
  Parts fresh = std::move(parts_.begin()->second);
  joined_ = parts_.begin()->first;
  parts_.erase(parts_.begin());
  AgentStates all;
  all.header.stamp = toStamp(joined_);
  all.header.frame_id = options_.frame_id;
  const auto add = [&all](const AgentStates& part) {
    all.hash += part.hash;
    all.agents.insert(all.agents.end(), part.agents.begin(), part.agents.end());
  };
  for (const auto& entry : fresh) add(entry.second);
  for (const auto& [owner, part] : last_parts_)
    if (fresh.count(owner) == 0) add(part);
  const auto is_before = [](const AgentState& a, const AgentState& b) { return a.id < b.id; };
  std::stable_sort(all.agents.begin(), all.agents.end(), is_before);
  const auto is_same = [](const AgentState& a, const AgentState& b) { return a.id == b.id; };
  all.agents.erase(std::unique(all.agents.begin(), all.agents.end(), is_same), all.agents.end());
  for (auto& [owner, part] : fresh) last_parts_[owner] = std::move(part);
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
