// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/message_traits.h>
#include <ros/node_handle.h>

#include <string>

#include "nodes/shard_requests/shard_registry.h"

namespace vegetation_sim {

/// Returns the md5 sums of types of messages, which identify their versions.
template <class... Messages>
std::string listMessages() {
  std::string out;
  for (const char* sum : {ros::message_traits::md5sum<Messages>()...})
    out += (out.empty() ? "" : " ") + std::string(sum);
  return out;
}

/// @throws InvalidInput if a message names no shard of 1 to MOST_SHARDS.
void checkShard(const ShardNode& message);

/// Waits until all processes that announce shards on a topic have been heard, at most 2 s of wall
/// time. @throws InvalidInput that names a node which started before this one and does not fit.
void requireFit(const ros::NodeHandle& handle, const std::string& topic,
                const ShardRegistry& registry);

/// Waits as requireFit() does. @param node without a shard, that animates the whole.
/// @throws InvalidInput that names the node of a shard, if there is one.
void requireNoShards(const ros::NodeHandle& handle, const std::string& topic,
                     const std::string& node);

/// @throws InvalidInput always, since a shard and a node without one animate the same.
[[noreturn]] void refuseShard(const ShardNode& message, const std::string& node);

}  // namespace vegetation_sim
