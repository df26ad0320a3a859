// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/shard_requests/shard_registry.h"

#include <ros/names.h>

#include <tuple>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {
namespace {

constexpr std::chrono::seconds LONGEST_SILENCE{3};
constexpr std::size_t LONGEST_NODE = 256;  // letters of a name

// roscpp throws for a service below another name.
void checkName(const std::string& node) {
  std::string why;
  if (node.empty() || node.size() > LONGEST_NODE || node[0] != '/' ||
      !ros::names::validate(node, why))
    throw InvalidInput("node = " + inQuotes(node) + "; allowed are resolved names of up to " +
                       std::to_string(LONGEST_NODE) + " letters");
}

}  // namespace

std::string describeShard(std::uint32_t shard, std::uint32_t count) {
  return "shard " + std::to_string(shard) + " of " + std::to_string(count);
}

void ShardRegistry::checkFit(const ShardNode& message) const {
  checkName(message.node);
  const std::string who = message.node + " is " + describeShard(message.shard, message.shards);
  const auto refuse = [&](const char* what, const std::string& value, const std::string& allowed) {
    throw InvalidInput(who + " with " + what + " = " + value + "; allowed is that of this node, " +
                       own_.node + ", " + allowed);
  };
  if (message.shards != own_.shards)
    refuse("shard/count", std::to_string(message.shards), std::to_string(own_.shards));
  if (message.shard >= own_.shards)
    throw InvalidInput(who + "; allowed is an index from 0 to " + std::to_string(own_.shards - 1));
  if (message.messages != own_.messages)
    refuse("the version of messages", message.messages, own_.messages);
  if (message.terrain_hash != own_.terrain_hash)
    refuse("the hash of the scenario's terrain", std::to_string(message.terrain_hash),
           std::to_string(own_.terrain_hash));
  if (message.layout_hash != own_.layout_hash)
    refuse("the hash of the scenario's layout", std::to_string(message.layout_hash),
           std::to_string(own_.layout_hash));
  if (message.rate != own_.rate)
    refuse("state_rate", std::to_string(message.rate), std::to_string(own_.rate));
  if (message.shard == own_.shard)
    throw InvalidInput(who + ", as this node, " + own_.node + ", is; a shard has one node");
}

void ShardRegistry::hear(const ShardNode& message, const std::string& process, SteadyTime now) {
  if (message.node == own_.node) return;
  checkFit(message);
  const std::lock_guard<std::mutex> lock(mutex_);
  heard_[message.shard] = now;
  processes_[message.shard] = process;
  if (!message.open) return;
  auto& peer = peers_[message.shard];
  if (peer && peer->node == message.node && peer->started == message.started) return;
  peer = std::make_shared<Peer>();  // a node that has started again owes no answers
  peer->node = message.node;
  peer->started = message.started;
}

void ShardRegistry::checkSender(std::uint32_t shard, const std::string& process) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = processes_.find(shard);
  if (found != processes_.end() && found->second != process)
    throw InvalidInput(describeShard(shard, own_.shards) + ": sender = " + process +
                       "; allowed is that of the shard, " + found->second);
}

bool ShardRegistry::isEarlier(const ShardNode& message) const {
  return message.open ||
         std::tie(message.started, message.node) < std::tie(own_.started, own_.node);
}

bool ShardRegistry::isOpen(std::uint32_t shard) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return peers_.count(shard) > 0;
}

std::shared_ptr<ShardRegistry::Peer> ShardRegistry::find(std::uint32_t shard) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = peers_.find(shard);
  if (found == peers_.end())
    throw InvalidInput(describeShard(shard, own_.shards) + " is animated by no node",
                       FaultCode::NOT_AVAILABLE);
  return found->second;
}

std::string ShardRegistry::describeMissing() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string out;
  for (std::uint32_t shard = 0; shard < own_.shards; ++shard)
    if (shard != own_.shard && peers_.count(shard) == 0)
      out += (out.empty() ? "" : ", ") + std::to_string(shard);
  return out;
}

std::string ShardRegistry::describeSilent(SteadyTime now) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string out;
  for (const auto& [shard, peer] : peers_)
    if (now - heard_.at(shard) > LONGEST_SILENCE)
      out += (out.empty() ? "" : ", ") + std::to_string(shard) + " (" + peer->node + ")";
  return out;
}

}  // namespace vegetation_sim
