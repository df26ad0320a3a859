// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/shards/shard_check.h"

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

// Hears all nodes that announce shards on a topic, those of this process too, and waits at most
// LONGEST_EARLY_WAIT.
void hearShards(ros::NodeHandle handle, const std::string& topic,
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
  bool are_all_heard;
  do {  // once more after all processes were heard, since one may have several nodelets
    are_all_heard = all_heard();
    queue.callAvailable(ros::WallDuration(EARLY_POLL));
  } while (!are_all_heard && ros::WallTime::now() < end && ros::ok());
  subscriber.shutdown();
}

}  // namespace

void requireFit(const ros::NodeHandle& handle, const std::string& topic,
                const ShardRegistry& registry) {
  std::optional<ShardNode> first, same;  // that started before: the earliest, and one of this shard
  hearShards(handle, topic, [&](const ShardNode& message) {
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
  hearShards(handle, topic, [&](const ShardNode& message) { any = message; });
  if (any) refuseShard(*any, node);
}

void refuseShard(const ShardNode& message, const std::string& node) {
  throw InvalidInput(message.node + " is " + describeShard(message.shard, message.shards) +
                     ", but this node, " + node +
                     ", animates the whole; allowed are nodes of shards only, or "
                     "one node of the whole");
}

}  // namespace vegetation_sim
