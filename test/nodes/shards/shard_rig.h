// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <XmlRpc.h>
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>
#include <ros/network.h>
#include <tf2_msgs/TFMessage.h>
#include <vegetation_sim/ApplyForce.h>
#include <vegetation_sim/CutBranch.h>
#include <vegetation_sim/Grab.h>
#include <vegetation_sim/MoveGrab.h>
#include <vegetation_sim/Release.h>
#include <vegetation_sim/WindField.h>

#include <map>
#include <string>
#include <utility>

#include "nodes/rigs/forest_rig.h"
#include "nodes/snapshots/event_inputs.h"
#include "ros/replicas/subscribed_forest.h"
#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim {

constexpr std::int64_t FIRST_TICK = 30 * 1000000;
constexpr std::uint32_t SHARDS = 2;
inline const std::string WHOLE = "/whole/forest_animator";

inline int pidOf(const std::string& node) {
  XmlRpc::XmlRpcValue request, response, pid;
  std::string host;
  std::uint32_t port = 0;
  request[0] = "/test";
  request[1] = node;
  if (!ros::master::execute("lookupNode", request, response, pid, false) ||
      !ros::network::splitURI(pid, host, port))
    throw std::runtime_error("no " + node);
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port));
  XmlRpc::XmlRpcValue caller, reply;
  caller[0] = "/test";
  if (!client.execute("getPid", caller, reply)) throw std::runtime_error("no pid of " + node);
  return reply[2];
}

// A node's hash of its trees, by stamp.
using Hashes = std::map<ros::Time, std::uint64_t>;

class ShardedNodes {
 public:
  ShardedNodes() {
    ros::NodeHandle handle;
    clock_ = handle.advertise<rosgraph_msgs::Clock>("/clock", 100);
    tf_ = handle.advertise<tf2_msgs::TFMessage>("/tf", 100);
    wind_ = handle.advertise<WindField>("/wind", 1, true);
    replica.subscribe(handle, {});
    whole_replica.subscribe(handle, {"/whole/forest/layout", "/wind", "/whole/forest/state"});
    for (const std::string& node : {shardName(0), shardName(1), WHOLE})
      if (!ros::service::waitForService(node + "/tf2_frames", ros::Duration(-1)))
        throw std::runtime_error("no " + node);
    wind::Primitive breeze = forest::makeBreeze(1, Vec3(4.0, 1.0, 0.0));
    breeze.turbulence = 0.4;
    wind_.publish(toMsg(wind::Field({breeze}, 3), "map", 0));
    // This process, three nodes; tf has a listener of the node and one of its bodies.
    spinUntil("listeners", [this] {
      return clock_.getNumSubscribers() >= 4 && tf_.getNumSubscribers() >= 3 &&
             wind_.getNumSubscribers() >= 4;
    });
    spinUntil("all publishers", [this] {
      return replica.rivals().find("publishers of /forest/state") != std::string::npos;
    });
    spinUntil("layouts",
              [this] { return replica.layoutStatus().good && whole_replica.layoutStatus().good; });
    owners = forest::TreeOwners(replica.replica().layout(), {0, SHARDS});
  }

  static std::string shardName(std::uint32_t shard) { return "/shard_" + std::to_string(shard); }
  std::string ownerOf(std::uint32_t tree) const { return shardName(owners.ownerOf(tree)); }

  /// Shows where the two bodies are at the next tick, and advances to it with at least this many
  /// shards.
  void run(const Vec3& left, const Vec3& right, std::uint32_t shards = SHARDS) {
    const Nanoseconds due = grid_.timeOf(++tick_);
    tf2_msgs::TFMessage frames;
    for (const auto& [name, place] :
         {std::pair("left_hand", left), std::pair("right_hand", right)}) {
      geometry_msgs::TransformStamped frame;
      frame.header.stamp = toStamp(due);
      frame.header.frame_id = "map";
      frame.child_frame_id = name;
      frame.transform.translation = toVector(place);
      frame.transform.rotation.w = 1.0;
      frames.transforms.push_back(frame);
    }
    tf_.publish(frames);
    rosgraph_msgs::Clock message;
    message.clock = toStamp(due + grid_.timeOf(1) / 2);
    clock_.publish(message);
    const ros::Time stamp = toStamp(due);
    spinUntil("states of " + std::to_string(tick_ - FIRST_TICK),
              [&] { return counts_[stamp] >= shards && whole_hashes.count(stamp) > 0; });
  }

  /// Returns the stamp of the last tick once both replicas have it.
  Nanoseconds settle() {
    const Nanoseconds stamp = grid_.timeOf(tick_);
    spinUntil("both replicas", [&] {
      return replica.replica().stamp() == stamp && whole_replica.replica().stamp() == stamp;
    });
    return stamp;
  }

  template <class Service>
  typename Service::Response call(const std::string& node, const std::string& name,
                                  const typename Service::Request& request) {
    Service call;
    call.request = request;
    for (int attempt = 0; attempt < 3; ++attempt)
      if (ros::service::call(node + "/" + name, call)) return call.response;
    throw std::runtime_error(node + "/" + name + " did not answer");
  }

  SubscribedForest replica, whole_replica;
  forest::TreeOwners owners;
  Hashes sums, whole_hashes;

 private:
  TickGrid grid_{30};
  std::int64_t tick_{FIRST_TICK};
  std::map<ros::Time, std::uint32_t> counts_;
  ros::Publisher clock_, tf_, wind_;
  ros::Subscriber shards_{ros::NodeHandle().subscribe<ForestState>(
      "/forest/state", 1000,
      boost::function<void(const ForestState&)>([this](const ForestState& state) {
        EXPECT_EQ(state.shards, SHARDS);
        sums[state.header.stamp] += state.trees_hash;
        ++counts_[state.header.stamp];
      }))};
  ros::Subscriber whole_{ros::NodeHandle().subscribe<ForestState>(
      "/whole/forest/state", 1000,
      boost::function<void(const ForestState&)>([this](const ForestState& state) {
        EXPECT_EQ(state.shards, 1u);
        whole_hashes[state.header.stamp] = state.trees_hash;
      }))};
};

struct HeldTwice {
  std::uint32_t tree{0}, id{0}, whole_id{0};
  Vec3 target;
};

class ForestShardNodes : public testing::Test {
 protected:
  static void SetUpTestSuite() { nodes_ = new ShardedNodes(); }
  static void TearDownTestSuite() { delete nodes_; }

  static std::uint32_t treeOf(std::uint32_t shard, std::uint32_t number = 0) {
    std::uint32_t tree = 0;
    for (;; ++tree)
      if (nodes_->owners.ownerOf(tree) == shard && number-- == 0) return tree;
  }
  /// Returns the base of the first branch of depth 1, world.
  static Vec3 limbOf(std::uint32_t tree) {
    const forest::Tree grown = nodes_->replica.replica().grow(tree);
    return Vec3(grown.foot + grown.skeleton.branches[limb(grown)].rest.position);
  }
  static std::size_t limb(const forest::Tree& tree) {
    return static_cast<std::size_t>(tree.skeleton.depth_end[0]);
  }
  /// Holds a limb in both forests.
  static HeldTwice hold(std::uint32_t tree) {
    Grab::Request request;
    request.tree = tree;
    request.branch = static_cast<std::uint32_t>(limb(nodes_->replica.replica().grow(tree)));
    request.along = 0.2;
    HeldTwice out;
    out.tree = tree;
    out.target = limbOf(tree) + Vec3(0.1, 0.1, 0.1);
    request.target.header.frame_id = "map";
    request.target.point = toPoint(out.target);
    for (const std::string& node : {nodes_->ownerOf(tree), WHOLE}) {
      const Grab::Response answer = nodes_->call<Grab>(node, "grab", request);
      EXPECT_TRUE(answer.success) << node << ": " << answer.message;
      (node == WHOLE ? out.whole_id : out.id) = answer.id;
    }
    return out;
  }
  template <class Service>
  static void askBoth(const char* name, std::uint32_t tree,
                      const typename Service::Request& request) {
    for (const std::string& node : {nodes_->ownerOf(tree), WHOLE}) {
      const auto answer = nodes_->call<Service>(node, name, request);
      EXPECT_TRUE(answer.success) << node << ": " << answer.message;
    }
  }
  static void move(HeldTwice& held, const Vec3& way) {
    held.target += way;
    for (const auto& [node, id] :
         {std::pair(nodes_->ownerOf(held.tree), held.id), std::pair(WHOLE, held.whole_id)}) {
      MoveGrab::Request request;
      request.id = id;
      request.target.header.frame_id = "map";
      request.target.point = toPoint(held.target);
      const auto answer = nodes_->call<MoveGrab>(node, "move_grab", request);
      EXPECT_TRUE(answer.success) << node << ": " << answer.message;
    }
  }
  static void release(const HeldTwice& held) {
    for (const auto& [node, id] :
         {std::pair(nodes_->ownerOf(held.tree), held.id), std::pair(WHOLE, held.whole_id)}) {
      Release::Request request;
      request.id = id;
      EXPECT_TRUE(nodes_->call<Release>(node, "release", request).success) << node;
    }
  }

  /// Returns the answer through the node of shard 0, which is that through shard 1.
  template <class Service>
  static typename Service::Response answersAlike(const char* name,
                                                 const typename Service::Request& request) {
    const auto out = nodes_->call<Service>(ShardedNodes::shardName(0), name, request);
    EXPECT_EQ(bytesOf(nodes_->call<Service>(ShardedNodes::shardName(1), name, request)),
              bytesOf(out))
        << name << ": " << out.message;
    return out;
  }

  static ShardedNodes* nodes_;
};
inline ShardedNodes* ForestShardNodes::nodes_ = nullptr;

}  // namespace vegetation_sim
