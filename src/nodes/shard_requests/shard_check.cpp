// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/shard_requests/shard_check.h"

#include <XmlRpc.h>
#include <ros/callback_queue.h>
#include <ros/master.h>
#include <ros/this_node.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <set>

namespace vegetation_sim {
namespace {

constexpr double LONGEST_EARLY_WAIT = 2.0, EARLY_POLL = 0.02;  // [s] of wall time

/// Returns the names of the other processes that publish a topic; none if the master is silent.
std::set<std::string> listPublishers(const std::string& topic) {
  XmlRpc::XmlRpcValue request, response, state;
  request[0] = ros::this_node::getName();
  std::set<std::string> out;
  if (!ros::master::execute("getSystemState", request, response, state, false)) return out;
  XmlRpc::XmlRpcValue& published = state[0];
  for (int i = 0; i < published.size(); ++i)
    if (static_cast<std::string>(published[i][0]) == topic)
      for (int j = 0; j < published[i][1].size(); ++j) out.insert(published[i][1][j]);
  out.erase(ros::this_node::getName());
  return out;
}

// Hears all processes that announce shards on a topic, and waits at most LONGEST_EARLY_WAIT.
// @param in_process whether other nodelets of this process may announce shards: the master does not
// know them apart, so that they have all that time, in which each announces its shard again.
void hearShards(ros::NodeHandle handle, const std::string& topic, bool in_process,
                const std::function<void(const ShardNode&)>& take) {
  ros::CallbackQueue queue;
  handle.setCallbackQueue(&queue);
  std::set<std::string> heard;
  const boost::function<void(const ros::MessageEvent<const ShardNode>&)> hear =
      [&](const ros::MessageEvent<const ShardNode>& event) {
        heard.insert(event.getPublisherName());
        take(*event.getConstMessage());
      };
  ros::Subscriber subscriber = handle.subscribe<ShardNode>(topic, MOST_SHARDS, hear);
  const std::set<std::string> others = listPublishers(handle.resolveName(topic));
  const auto all_heard = [&] {
    return std::includes(heard.begin(), heard.end(), others.begin(), others.end());
  };
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(LONGEST_EARLY_WAIT);
  while ((in_process || !all_heard()) && ros::WallTime::now() < end && ros::ok())
    queue.callAvailable(ros::WallDuration(EARLY_POLL));
  subscriber.shutdown();
}

}  // namespace

void checkShard(const ShardNode& message) {
  if (message.shards < 1 || message.shards > MOST_SHARDS)
    throw InvalidInput("shards = " + std::to_string(message.shards) + "; allowed is 1 to " +
                       std::to_string(MOST_SHARDS));
  if (message.shard >= message.shards)
    throw InvalidInput("shard = " + std::to_string(message.shard) + "; allowed is 0 to " +
                       std::to_string(message.shards - 1));
}

void requireFit(const ros::NodeHandle& handle, const std::string& topic,
                const ShardRegistry& registry) {
  std::optional<ShardNode> first, same;  // that started before: the earliest, and one of this shard
  const bool is_nodelet = ros::this_node::getName() != registry.node();
  hearShards(handle, topic, is_nodelet, [&](const ShardNode& message) {
    if (!registry.isEarlier(message)) return;
    if (!first || message.started < first->started) first = message;
    if (message.shard == registry.shard().index) same = message;
  });
  for (const auto& earlier : {first, same})
    if (earlier) registry.checkFit(*earlier);
}

void requireNoShards(const ros::NodeHandle& handle, const std::string& topic,
                     const std::string& node) {
  std::optional<ShardNode> any;
  hearShards(handle, topic, false, [&](const ShardNode& message) { any = message; });
  if (any) refuseShard(*any, node);
}

void refuseShard(const ShardNode& message, const std::string& node) {
  throw InvalidInput(message.node + " is " + describeShard(message.shard, message.shards) +
                     ", but this node, " + node +
                     ", animates the whole; allowed are nodes of shards only, or "
                     "one node of the whole");
}

}  // namespace vegetation_sim
