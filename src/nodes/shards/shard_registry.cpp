// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/shards/shard_registry.h"

namespace vegetation_sim {

std::string describeShard(std::uint32_t shard, std::uint32_t count) {
  return "shard " + std::to_string(shard) + " of " + std::to_string(count);
}

void ShardRegistry::hear(const ShardNode& message) {
  if (message.node == node_) return;
  if (message.shards != shard_.count || message.shard >= shard_.count)
    throw InvalidInput(message.node + " is " + describeShard(message.shard, message.shards) +
                       "; allowed is a shard from 0 to " + std::to_string(shard_.count - 1) +
                       " of " + std::to_string(shard_.count));
  if (message.shard == shard_.index)
    throw InvalidInput(message.node + " is " + describeShard(message.shard, message.shards) +
                       ", as this node, " + node_ + ", is; a shard has one node");
  const std::lock_guard<std::mutex> lock(mutex_);
  auto& peer = peers_[message.shard];
  peer = std::make_shared<Peer>();  // a node that has started again owes no answers
  peer->node = message.node;
}

std::shared_ptr<ShardRegistry::Peer> ShardRegistry::find(std::uint32_t shard) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = peers_.find(shard);
  if (found == peers_.end())
    throw InvalidInput(describeShard(shard, shard_.count) + " is animated by no node",
                       FaultCode::NOT_AVAILABLE);
  return found->second;
}

std::string ShardRegistry::describeMissing() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string out;
  for (std::uint32_t shard = 0; shard < shard_.count; ++shard)
    if (shard != shard_.index && peers_.count(shard) == 0)
      out += (out.empty() ? "" : ", ") + std::to_string(shard);
  return out;
}

}  // namespace vegetation_sim
