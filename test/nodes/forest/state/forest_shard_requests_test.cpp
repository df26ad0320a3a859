// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Two nodes that share a forest answer requests for each other's trees.
#include <signal.h>
#include <vegetation_sim/ErrorCode.h>
#include <vegetation_sim/FindBranch.h>
#include <vegetation_sim/Pick.h>
#include <vegetation_sim/SetTf.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "nodes/shards/shard_rig.h"

namespace vegetation_sim {
namespace {

class ForestShardRequests : public ForestShardNodes {
 protected:
  // The nodes answer once time has begun, and for each other once they have found each other.
  static void SetUpTestSuite() {
    ForestShardNodes::SetUpTestSuite();
    nodes_->run(AWAY, AWAY);
    for (const std::string& node : {ShardedNodes::shardName(0), ShardedNodes::shardName(1), WHOLE})
      ros::service::waitForService(node + "/get_tree", ros::Duration(-1));
    for (const std::uint32_t owner : {0u, 1u})
      spinUntil("shard " + std::to_string(owner), [&] {
        GetTree::Request theirs;
        theirs.tree = treeOf(owner);
        return nodes_->call<GetTree>(ShardedNodes::shardName(1 - owner), "get_tree", theirs)
                   .success != 0;
      });
  }
  static const Vec3 AWAY;
};
const Vec3 ForestShardRequests::AWAY(0.0, 0.0, 500.0);

// ~owned/NAME is for the trees of the shard, and passes nothing on.
TEST_F(ForestShardRequests, OwnedServicesRefuseTreesOfOthersAndNameTheOwner) {
  const std::uint32_t theirs = treeOf(1);
  const std::string shard = ShardedNodes::shardName(0),
                    why = "tree = " + std::to_string(theirs) +
                          " belongs to shard 1 of 2, this is shard 0";
  GetTree::Request tree;
  tree.tree = theirs;
  EXPECT_EQ(nodes_->call<GetTree>(shard, "owned/get_tree", tree).message, "get_tree: " + why);
  CutBranch::Request cut;
  cut.tree = theirs;
  cut.branch = 1;
  const auto answer = nodes_->call<CutBranch>(shard, "owned/cut_branch", cut);
  EXPECT_FALSE(answer.success);
  EXPECT_EQ(answer.message, "cut: " + why);
  Release::Request release;
  release.id = 2;  // of shard 1
  EXPECT_EQ(nodes_->call<Release>(shard, "owned/release", release).message,
            "id = 2 is of shard 1 of 2, this is shard 0");
}

// Requests that change nothing have the same answer through either node, bit by bit.
TEST_F(ForestShardRequests, AnswerAlikeThroughEitherNode) {
  for (const std::uint32_t owner : {0u, 1u}) {
    const std::uint32_t tree = treeOf(owner);
    GetTree::Request get;
    get.tree = tree;
    EXPECT_TRUE(answersAlike<GetTree>("get_tree", get).success);
    FindBranch::Request nearest;
    nearest.point.header.frame_id = "map";
    nearest.point.point = toPoint(Vec3(limbOf(tree) + Vec3(0.2, 0.1, 0.1)));
    const auto found = answersAlike<FindBranch>("find_branch", nearest);
    EXPECT_TRUE(found.success) << found.message;
    EXPECT_LT(found.distance, 0.3);
    Pick::Request ray;
    ray.header.frame_id = "map";
    ray.origin = toPoint(Vec3(limbOf(tree) + Vec3(-60.0, 0.0, 0.0)));
    ray.direction.x = 1.0;
    ray.tolerance = 0.5;
    const auto hit = answersAlike<Pick>("pick", ray);
    EXPECT_TRUE(hit.success) << hit.message;
    EXPECT_LT(hit.distance, 60.5);
    SetTf::Request frames;
    frames.tree = tree;
    frames.branches = {0};
    EXPECT_TRUE(answersAlike<SetTf>("set_tf", frames).success);
  }
  GetTree::Request unknown;
  unknown.tree = 4000000;
  EXPECT_FALSE(answersAlike<GetTree>("get_tree", unknown).success);
  Pick::Request up;
  up.origin.z = 500.0;
  up.direction.z = 1.0;
  EXPECT_EQ(answersAlike<Pick>("pick", up).error_code, ErrorCode::NOTHING_FOUND);
  MoveGrab::Request move;
  move.id = 1000;  // of shard 1
  EXPECT_EQ(answersAlike<MoveGrab>("move_grab", move).error_code, ErrorCode::UNKNOWN);
}

// A ray through the crowns of both shards meets the tree that it meets in one node.
TEST_F(ForestShardRequests, PickTheNearestOfAllTrees) {
  const Vec3 start = limbOf(treeOf(0)), end = limbOf(treeOf(1));
  for (const bool back : {false, true}) {
    const Vec3 from = back ? end : start, to = back ? start : end;
    const Vec3 way = to - from;
    Pick::Request ray;
    ray.header.frame_id = "map";
    ray.origin = toPoint(Vec3(from - 20.0 * way / length(way)));
    ray.direction = toVector(way);
    ray.tolerance = 0.3;
    const auto whole = nodes_->call<Pick>(WHOLE, "pick", ray);
    ASSERT_TRUE(whole.success) << whole.message;
    const auto hit = answersAlike<Pick>("pick", ray);
    EXPECT_EQ(hit.tree, whole.tree);
    EXPECT_EQ(hit.branch, whole.branch);
    EXPECT_EQ(hit.distance, whole.distance);
  }
}

// Requests that act reach the owner through the other node, and the world stays that of one node.
TEST_F(ForestShardRequests, PassRequestsOnToTheOwner) {
  nodes_->run(AWAY, AWAY);
  for (const std::uint32_t owner : {0u, 1u}) {
    const std::uint32_t tree = treeOf(owner, 2);
    const auto branch = static_cast<std::uint32_t>(limb(nodes_->replica.replica().grow(tree)));
    const std::string wrong = ShardedNodes::shardName(1 - owner);
    Grab::Request grab;
    grab.nearest = true;
    grab.point.header.frame_id = grab.target.header.frame_id = "map";
    grab.point.point = toPoint(limbOf(tree));
    grab.target.point = toPoint(Vec3(limbOf(tree) + Vec3(0.1, 0.0, 0.1)));
    const auto held = nodes_->call<Grab>(wrong, "grab", grab);
    ASSERT_TRUE(held.success) << held.message;
    const auto whole = nodes_->call<Grab>(WHOLE, "grab", grab);
    EXPECT_EQ(shardOfId(held.id, SHARDS), nodes_->owners.ownerOf(held.tree));
    EXPECT_EQ(held.tree, whole.tree);
    EXPECT_EQ(held.branch, whole.branch);
    nodes_->run(AWAY, AWAY);
    for (const auto& [node, id] : {std::pair(wrong, held.id), std::pair(WHOLE, whole.id)}) {
      MoveGrab::Request move;
      move.id = id;
      move.target.header.frame_id = "map";
      move.target.point = toPoint(Vec3(limbOf(tree) + Vec3(0.2, 0.0, 0.1)));
      EXPECT_TRUE(nodes_->call<MoveGrab>(node, "move_grab", move).success);
      ApplyForce::Request push;
      push.tree = tree;
      push.branch = branch;
      push.force.vector.y = 30.0;
      push.duration = 0.2;
      EXPECT_TRUE(nodes_->call<ApplyForce>(node, "apply_force", push).success);
    }
    for (int tick = 0; tick < 10; ++tick) nodes_->run(AWAY, AWAY);
    for (const auto& [node, id] : {std::pair(wrong, held.id), std::pair(WHOLE, whole.id)}) {
      Release::Request release;
      release.id = id;
      EXPECT_TRUE(nodes_->call<Release>(node, "release", release).success);
      CutBranch::Request cut;
      cut.tree = tree;
      cut.branch = branch + 1;
      EXPECT_TRUE(nodes_->call<CutBranch>(node, "cut_branch", cut).success);
    }
    for (int tick = 0; tick < 10; ++tick) nodes_->run(AWAY, AWAY);
  }
  for (const auto& [stamp, hash] : nodes_->whole_hashes)
    ASSERT_EQ(nodes_->sums[stamp], hash) << stamp;
  Release::Request all;
  all.all = true;
  EXPECT_EQ(nodes_->call<Release>(ShardedNodes::shardName(0), "release", all).message,
            "0 released");
}

// Each node asks the other all the time: neither waits for ever, and ticks go on.
TEST_F(ForestShardRequests, AskEachOtherAtOnce) {
  constexpr int CALLERS = 3, CALLS = 40;
  std::atomic<int> answered{0}, finished{0};
  std::vector<std::thread> callers;
  for (const std::uint32_t owner : {0u, 1u})
    for (int i = 0; i < CALLERS; ++i)
      callers.emplace_back([&, owner] {
        for (int k = 0; k < CALLS; ++k) {
          GetTree::Request request;
          request.tree = treeOf(owner);
          answered += nodes_->call<GetTree>(ShardedNodes::shardName(1 - owner), "get_tree", request)
                          .success;
        }
        ++finished;
      });
  int ticks = 0;
  for (; ticks < 10 || finished < 2 * CALLERS; ++ticks) nodes_->run(AWAY, AWAY);
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(answered, 2 * CALLERS * CALLS);
}

// An owner that is silent is named within the time limit, and the node goes on meanwhile.
TEST_F(ForestShardRequests, NameAnOwnerThatIsSilent) {
  GetTree::Request theirs, ours;
  theirs.tree = treeOf(1);
  ours.tree = treeOf(0);
  const int pid = pidOf("/shard_1");
  ASSERT_EQ(kill(pid, SIGSTOP), 0);
  const auto begin = std::chrono::steady_clock::now();
  GetTree::Response late;
  std::thread caller([&] { late = nodes_->call<GetTree>("/shard_0", "get_tree", theirs); });
  EXPECT_TRUE(nodes_->call<GetTree>("/shard_0", "get_tree", ours).success);
  const std::chrono::duration<double> for_ours = std::chrono::steady_clock::now() - begin;
  caller.join();
  const std::chrono::duration<double> for_theirs = std::chrono::steady_clock::now() - begin;
  EXPECT_EQ(late.message,
            "shard 1 of 2, /shard_1, does not answer ~get_tree within 2 s; it may still carry out "
            "the request");
  EXPECT_EQ(late.error_code, ErrorCode::NOT_AVAILABLE);
  EXPECT_LT(for_ours.count(), 1.5);
  EXPECT_LT(for_theirs.count(), 4.0);
  EXPECT_EQ(nodes_->call<GetTree>("/shard_0", "get_tree", theirs).message,
            "shard 1 of 2, /shard_1, has not answered an earlier request yet");
  ASSERT_EQ(kill(pid, SIGCONT), 0);
  spinUntil("shard 1",
            [&] { return nodes_->call<GetTree>("/shard_0", "get_tree", theirs).success; });
}

// The last test, because the world of the node that starts again differs from that in one node.
TEST_F(ForestShardRequests, FindAnOwnerThatHasStartedAgain) {
  GetTree::Request theirs;
  theirs.tree = treeOf(1);
  ASSERT_TRUE(nodes_->call<GetTree>("/shard_0", "get_tree", theirs).success);
  ASSERT_EQ(kill(pidOf("/shard_1"), SIGKILL), 0);
  const auto begin = std::chrono::steady_clock::now();
  const auto dead = nodes_->call<GetTree>("/shard_0", "get_tree", theirs);
  const std::chrono::duration<double> wait = std::chrono::steady_clock::now() - begin;
  // Its socket may close in the middle of the request.
  EXPECT_EQ(dead.message.find("shard 1 of 2, /shard_1, does not answer ~get_tree: "), 0u)
      << dead.message;
  EXPECT_EQ(dead.error_code, ErrorCode::NOT_AVAILABLE);
  EXPECT_LT(wait.count(), 3.0);
  const auto is_back = [&] {
    nodes_->run(AWAY, AWAY, 1);
    return nodes_->call<GetTree>("/shard_0", "get_tree", theirs).success != 0;
  };
  spinUntil("shard 1", is_back);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "forest_shard_requests_test");
  return RUN_ALL_TESTS();
}
