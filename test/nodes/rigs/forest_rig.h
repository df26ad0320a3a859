// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <tf2_msgs/FrameGraph.h>
#include <vegetation_sim/GetTree.h>

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "ros/params/resources.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {

/// Spins until a condition holds. The deadline [s] is wall time; only a test that fails waits that
/// long.
inline void spinUntil(const std::string& what, const std::function<bool()>& condition) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(60.0);
  while (!condition()) {
    if (ros::WallTime::now() > end) throw std::runtime_error("timed out waiting for " + what);
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.05));
  }
}

/// Keeps all messages of a topic.
template <class Message>
class LatestMessage {
 public:
  explicit LatestMessage(const std::string& topic) : topic_(topic) {
    const boost::function<void(const Message&)> receive = [this](const Message& message) {
      messages.push_back(message);
    };
    subscriber_ = ros::NodeHandle().subscribe<Message>(topic, 10000, receive);
  }
  const Message& last() {
    spinUntil(topic_, [this] { return !messages.empty(); });
    return messages.back();
  }
  void waitForPublisher() {
    spinUntil(topic_, [this] { return subscriber_.getNumPublishers() > 0; });
  }
  std::vector<Message> messages;

 private:
  std::string topic_;
  ros::Subscriber subscriber_;
};

/// A forest_animator whose clock the test sets. Time stands half a tick after a tick: the node has
/// reached that tick, and messages published now take effect at the next one.
class ClockedForest {
 public:
  explicit ClockedForest(std::int64_t first_tick) : tick_(first_tick) {
    clock_ = ros::NodeHandle().advertise<rosgraph_msgs::Clock>("/clock", 100);
    tree_ = ros::NodeHandle().serviceClient<GetTree>("forest_animator/get_tree");
    // Before time begins the node answers only this service.
    if (!ros::service::waitForService("forest_animator/tf2_frames", ros::Duration(-1)))
      throw std::runtime_error("no forest_animator");
    tf2_msgs::FrameGraph graph;
    for (int i = 0; i < 2; ++i) ros::service::call("forest_animator/tf2_frames", graph);
    state.waitForPublisher();
    // The subscribers are the node and this process.
    spinUntil("listeners of /clock", [this] { return clock_.getNumSubscribers() >= 2; });
  }

  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      const Nanoseconds due = grid_.timeOf(++tick_);
      rosgraph_msgs::Clock message;
      message.clock = toStamp(due + grid_.timeOf(1) / 2);
      clock_.publish(message);
      spinUntil("state", [&] {
        return !state.messages.empty() && fromMsg(state.messages.back().header.stamp) >= due;
      });
    }
  }

  void runUntil(const std::string& what, const std::function<bool()>& condition) {
    for (int i = 0; i < 3000; ++i, run(1))
      if (condition()) return;
    throw std::runtime_error("100 s passed without " + what);
  }

  /// Returns when the node has taken the messages that were in its sockets before.
  void settle() {
    for (int i = 0; i < 2; ++i) ask(UINT32_MAX);
  }

  GetTree::Response ask(std::uint32_t tree, const ros::Time& stamp = {}) {
    GetTree call;
    call.request.tree = tree;
    call.request.stamp = stamp;
    // Each call has a connection of its own, and roscpp gives up one that does not come about.
    for (int attempt = 0; attempt < 3; ++attempt)
      if (tree_.call(call)) return call.response;
    throw std::runtime_error("get_tree did not answer");
  }

  const TickGrid& grid() const { return grid_; }

  LatestMessage<ForestLayout> layout{"forest/layout"};
  LatestMessage<ForestState> state{"forest/state"};

 private:
  TickGrid grid_{30};
  std::int64_t tick_;
  ros::Publisher clock_;
  ros::ServiceClient tree_;
};

}  // namespace vegetation_sim
