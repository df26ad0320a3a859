// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The people of a shard, and of all shards, which shard 0 joins.
#include <optional>
#include <utility>

#include "nodes/crowd/agent_crowd.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double MOST_AHEAD = 10.0;  // of the people of another shard [s]

}  // namespace

void AgentCrowd::publishPart(Nanoseconds stamp) {
  if (showsAll() && (recovers() || stamp <= parts_->stamp())) return;
  CrowdPart part;
  part.starts = shard_->asksOthers();
  if (part.starts && showsAll()) return;
  part.shard = options_.shard->index;
  part.people = agentsAt(stamp);
  for (const crowd::Walker& walker : shard_->standing())
    part.waiting.push_back(toMsg(walker, crowd_.terrain()));
  part.heard = heard_now_;
  if (showsAll())
    joinPart(part);
  else
    parts_publisher_.publish(part);
}

void AgentCrowd::onPart(const CrowdPart& message) {
  acceptInput("agents/parts", [&] {
    const Nanoseconds stamp = fromMsg(message.people.header.stamp);
    check(message, options_.shard->count);
    const TickGrid& grid = clock_.grid();
    if (grid.timeOf(grid.tickAt(stamp)) != stamp)
      throw InvalidInput("stamp = " + std::to_string(stamp) + " ns is not that of a tick");
    const double ahead = secondsBetween(lastStamp(), stamp);
    if (clock_.hasBegun() && ahead > MOST_AHEAD)
      throw InvalidInput("stamp is " + std::to_string(ahead) + " s ahead, allowed are " +
                         std::to_string(MOST_AHEAD) + " s");
    checkFrame(message.people.header.frame_id, options_.frame_id);
    joinPart(message);
  });
}

// Publishes the people of each tick that this part completes.
void AgentCrowd::joinPart(const CrowdPart& part) {
  parts_->setTime(lastStamp());
  parts_->add(part);
  while (std::optional<JoinedPeople> people = parts_->take()) {
    AgentStates message;
    message.header.stamp = toStamp(people->stamp);
    message.header.frame_id = options_.frame_id;
    message.hash = people->hash;
    message.agents = std::move(people->agents);
    publishJoined(message);
  }
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
