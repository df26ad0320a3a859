// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/shards/shard_check.h"

#include <XmlRpc.h>
#include <ros/callback_queue.h>
#include <ros/master.h>
#include <ros/this_node.h>

#include <algorithm>
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

}  // namespace

void requireFit(ros::NodeHandle handle, const std::string& topic, const ShardRegistry& registry) {
  ros::CallbackQueue queue;
  handle.setCallbackQueue(&queue);
  std::set<std::string> heard;
  std::optional<ShardNode> first, same;  // that started before: the earliest, and one of this shard
  const boost::function<void(const ros::MessageEvent<const ShardNode>&)> hear =
      [&](const ros::MessageEvent<const ShardNode>& event) {
        heard.insert(event.getPublisherName());
        const ShardNode& message = *event.getConstMessage();
        if (!registry.isEarlier(message)) return;
        if (!first || message.started < first->started) first = message;
        if (message.shard == registry.shard().index) same = message;
      };
  ros::Subscriber subscriber = handle.subscribe<ShardNode>(topic, MOST_SHARDS, hear);
  const std::set<std::string> others = listPublishers(handle.resolveName(topic));
  const auto all_heard = [&] {
    return std::includes(heard.begin(), heard.end(), others.begin(), others.end());
  };
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(LONGEST_EARLY_WAIT);
  while (!all_heard() && ros::WallTime::now() < end && ros::ok())
    queue.callAvailable(ros::WallDuration(EARLY_POLL));
  subscriber.shutdown();
  for (const auto& earlier : {first, same})
    if (earlier) registry.checkFit(*earlier);
}

}  // namespace vegetation_sim
