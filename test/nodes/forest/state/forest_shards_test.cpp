// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Two nodes that share a forest are one world: their hashes add up to that of a node with all
// trees, and a subscriber merges their messages.
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>
#include <tf2_msgs/TFMessage.h>
#include <vegetation_sim/ApplyForce.h>
#include <vegetation_sim/CutBranch.h>
#include <vegetation_sim/Grab.h>
#include <vegetation_sim/MoveGrab.h>
#include <vegetation_sim/Release.h>
#include <vegetation_sim/WindField.h>

#include <cstdlib>
#include <map>
#include <set>

#include "nodes/rigs/forest_rig.h"
#include "ros/replicas/subscribed_forest.h"
#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim {
namespace {

constexpr std::int64_t FIRST_TICK = 30 * 1000000;
constexpr std::uint32_t SHARDS = 2;
const std::string WHOLE = "/whole/forest_animator";

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

  /// Shows where the two bodies are at the next tick, and advances to it.
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
              [&] { return counts_[stamp] == shards && whole_hashes.count(stamp) > 0; });
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

  static ShardedNodes* nodes_;
};
ShardedNodes* ForestShardNodes::nodes_ = nullptr;

TEST_F(ForestShardNodes, AreOneWorld) {
  const std::uint32_t first = treeOf(0), second = treeOf(1), third = treeOf(1, 1);
  const Vec3 left = limbOf(treeOf(0, 1)), right = limbOf(third);
  std::vector<HeldTwice> held;
  std::set<std::uint32_t> physical;  // trees
  for (int tick = 0; tick < 120; ++tick) {
    const Vec3 way(-1.2 + 0.02 * tick, 0.0, 0.1);
    nodes_->run(left + way, right + way);
    for (const std::uint32_t tree : nodes_->replica.replica().physicalTrees())
      physical.insert(tree);
    if (tick == 10) held.push_back(hold(second));
    if (tick == 17) held.push_back(hold(first));
    if (tick > 20 && tick < 50 && tick % 5 == 0)
      for (HeldTwice& grab : held) move(grab, Vec3(0.03, 0.0, -0.02));
    if (tick == 40) {
      ApplyForce::Request push;
      push.tree = third;
      push.branch = 0;
      push.along = 0.5;
      push.force.vector.x = 50.0;
      push.duration = 0.3;
      askBoth<ApplyForce>("apply_force", third, push);
    }
    if (tick == 55) {
      CutBranch::Request cut;
      cut.tree = first;
      cut.branch = static_cast<std::uint32_t>(limb(nodes_->replica.replica().grow(first))) + 1;
      askBoth<CutBranch>("cut_branch", first, cut);
    }
    if (tick == 70)
      for (const HeldTwice& grab : held) release(grab);
  }
  for (const std::uint32_t tree : {first, second, third, treeOf(0, 1)})
    EXPECT_EQ(physical.count(tree), 1u) << tree;
  ASSERT_GE(nodes_->whole_hashes.size(), 120u);
  std::size_t moving = 0;
  for (const auto& [stamp, hash] : nodes_->whole_hashes) {
    ASSERT_EQ(nodes_->sums[stamp], hash) << stamp;
    moving += hash != 0;
  }
  EXPECT_GT(moving, 100u);
  const Nanoseconds now = nodes_->whole_replica.replica().stamp();
  spinUntil("both shards", [&] { return nodes_->replica.replica().stamp() == now; });
  EXPECT_EQ(nodes_->replica.stateStatus(now).text, "In step: 2 shards");
  EXPECT_EQ(nodes_->replica.rivals(), "");
  const forest::ForestReplica &merged = nodes_->replica.replica(),
                              &whole = nodes_->whole_replica.replica();
  EXPECT_EQ(merged.physicalTrees(), whole.physicalTrees());
  EXPECT_EQ(merged.broken().size(), 1u);
  for (std::uint32_t tree = 0; tree < merged.layout().treeCount(); ++tree) {
    const forest::Tree grown = merged.grow(tree);
    const std::vector<Pose> here = merged.pose(grown, tree, now),
                            there = whole.pose(grown, tree, now);
    for (std::size_t i = 0; i < here.size(); ++i)
      ASSERT_EQ(here[i].position, there[i].position) << tree << " " << i;
  }
}

TEST_F(ForestShardNodes, RefuseTreesOfOthersAndNameTheOwner) {
  const std::uint32_t theirs = treeOf(1);
  const std::string shard = ShardedNodes::shardName(0),
                    why = "tree = " + std::to_string(theirs) +
                          " belongs to shard 1 of 2, this is shard 0";
  GetTree::Request tree;
  tree.tree = theirs;
  EXPECT_EQ(nodes_->call<GetTree>(shard, "get_tree", tree).message, "get_tree: " + why);
  CutBranch::Request cut;
  cut.tree = theirs;
  cut.branch = 1;
  const auto answer = nodes_->call<CutBranch>(shard, "cut_branch", cut);
  EXPECT_FALSE(answer.success);
  EXPECT_EQ(answer.message, "cut: " + why);
  Release::Request release;
  release.id = 2;  // of shard 1
  EXPECT_EQ(nodes_->call<Release>(shard, "release", release).message,
            "id = 2 is of shard 1 of 2, this is shard 0");
}

// The last test, because a node ends: its trees stand still, and the subscriber names it.
TEST_F(ForestShardNodes, AShardThatDiesIsNamed) {
  ASSERT_EQ(std::system("rosnode kill /shard_1 > /dev/null"), 0);
  const Vec3 away(0.0, 0.0, 500.0);
  Nanoseconds now = 0;
  for (int tick = 0; tick < 150; ++tick) {
    nodes_->run(away, away, 1);
    now = nodes_->replica.replica().stampOf(0);
  }
  EXPECT_EQ(nodes_->replica.stateStatus(now).text,
            "Shard 1: No message for 3 s: drawn as it was then");
  EXPECT_TRUE(nodes_->replica.shardStatus(0, now).good);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "forest_shards_test");
  return RUN_ALL_TESTS();
}
