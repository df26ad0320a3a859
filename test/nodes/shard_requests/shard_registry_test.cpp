// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/shard_requests/shard_registry.h"

#include <gtest/gtest.h>
#include <vegetation_sim/Pick.h>

#include "core/error_text.h"
#include "nodes/shard_requests/shard_merges.h"

namespace vegetation_sim {
namespace {

ShardNode announced(std::uint32_t shard, std::uint32_t shards, const std::string& node) {
  ShardNode out;
  out.shard = shard;
  out.shards = shards;
  out.node = node;
  out.open = true;
  out.started = ros::Time(100.0 + shard);
  out.messages = "1a 2b";
  out.layout_hash = 7;
  out.terrain_hash = 8;
  out.rate = 30;
  return out;
}

const std::string PROCESS = "/manager";
constexpr ShardRegistry::SteadyTime BEGIN{};
constexpr std::chrono::seconds SECOND{1};

TEST(ShardRegistry, KnowsTheLatestNodeOfEachShard) {
  ShardRegistry registry(announced(1, 3, "/own"));
  EXPECT_EQ(registry.describeMissing(), "0, 2");
  registry.hear(announced(1, 3, "/own"), PROCESS, BEGIN);
  ShardNode starting = announced(2, 3, "/first");
  starting.open = false;
  registry.hear(starting, PROCESS, BEGIN);
  EXPECT_EQ(registry.describeMissing(), "0, 2");
  registry.hear(announced(2, 3, "/first"), PROCESS, BEGIN);
  const auto first = registry.find(2);
  first->overdue = 1;
  EXPECT_EQ(first->node, "/first");
  registry.hear(announced(2, 3, "/first"), PROCESS, BEGIN);
  EXPECT_EQ(registry.find(2)->overdue, 1);
  ShardNode again = announced(2, 3, "/first");
  again.started = ros::Time(200.0);
  registry.hear(again, PROCESS, BEGIN);
  EXPECT_EQ(registry.find(2)->overdue, 0);
  registry.hear(announced(2, 3, "/second"), PROCESS, BEGIN);
  EXPECT_EQ(registry.find(2)->node, "/second");
  EXPECT_EQ(registry.find(2)->overdue, 0);
  EXPECT_EQ(registry.describeMissing(), "0");
  EXPECT_EQ(errorOf([&] { registry.find(0); }), "shard 0 of 3 is animated by no node");
}

TEST(ShardRegistry, RefusesMessagesOfOtherProcesses) {
  ShardRegistry registry(announced(1, 3, "/own"));
  registry.checkSender(2, "/anybody");  // before the shard is known
  registry.hear(announced(2, 3, "/second"), PROCESS, BEGIN);
  registry.checkSender(2, PROCESS);
  EXPECT_EQ(errorOf([&] { registry.checkSender(2, "/second"); }),
            "shard 2 of 3: sender = /second; allowed is that of the shard, /manager");
  registry.hear(announced(2, 3, "/second"), "/second", BEGIN);
  registry.checkSender(2, "/second");
}

TEST(ShardRegistry, NamesSilentNodes) {
  ShardRegistry registry(announced(1, 3, "/own"));
  registry.hear(announced(0, 3, "/first"), PROCESS, BEGIN);
  registry.hear(announced(2, 3, "/second"), PROCESS, BEGIN);
  EXPECT_EQ(registry.describeSilent(BEGIN + 3 * SECOND), "");
  registry.hear(announced(2, 3, "/second"), PROCESS, BEGIN + 2 * SECOND);
  EXPECT_EQ(registry.describeSilent(BEGIN + 4 * SECOND), "0 (/first)");
  EXPECT_EQ(registry.describeSilent(BEGIN + 6 * SECOND), "0 (/first), 2 (/second)");
  registry.hear(announced(0, 3, "/first"), PROCESS, BEGIN + 6 * SECOND);
  EXPECT_EQ(registry.describeSilent(BEGIN + 6 * SECOND), "2 (/second)");
}

TEST(ShardRegistry, NamesNodesThatDoNotFit) {
  ShardRegistry registry(announced(1, 3, "/own"));
  const auto refusal = [&](const ShardNode& other) {
    return errorOf([&] { registry.hear(other, PROCESS, BEGIN); });
  };
  EXPECT_EQ(refusal(announced(1, 3, "/other")),
            "/other is shard 1 of 3, as this node, /own, is; a shard has one node");
  EXPECT_EQ(refusal(announced(0, 2, "/other")),
            "/other is shard 0 of 2 with shard/count = 2; allowed is that of this node, /own, 3");
  EXPECT_EQ(refusal(announced(3, 3, "/other")),
            "/other is shard 3 of 3; allowed is an index from 0 to 2");
  const auto changed = [](auto member, auto value) {
    ShardNode out = announced(0, 3, "/other");
    out.*member = value;
    return out;
  };
  const std::string other = "/other is shard 0 of 3 with ",
                    allowed = "; allowed is that of this node, /own, ";
  EXPECT_EQ(refusal(changed(&ShardNode::messages, "1a 3c")),
            other + "the version of messages = 1a 3c" + allowed + "1a 2b");
  EXPECT_EQ(refusal(changed(&ShardNode::terrain_hash, 9u)),
            other + "the hash of the scenario's terrain = 9" + allowed + "8");
  EXPECT_EQ(refusal(changed(&ShardNode::layout_hash, 9u)),
            other + "the hash of the scenario's layout = 9" + allowed + "7");
  EXPECT_EQ(refusal(changed(&ShardNode::rate, 20u)), other + "state_rate = 20" + allowed + "30");
  EXPECT_EQ(registry.describeMissing(), "0, 2");
  // Of two nodes that start, the later one does not run.
  const auto starting = [](std::uint32_t shard, const std::string& node) {
    ShardNode out = announced(shard, 2, node);
    out.open = false;
    return out;
  };
  EXPECT_TRUE(registry.isEarlier(starting(0, "/other")));
  EXPECT_FALSE(registry.isEarlier(starting(2, "/other")));
  EXPECT_FALSE(registry.isEarlier(starting(1, "/own")));
  // One that answers requests was there before, also if the clock of its host is ahead.
  EXPECT_TRUE(registry.isEarlier(announced(2, 2, "/other")));
}

// Services below the name of a node are called by name.
TEST(ShardRegistry, RefusesInvalidNames) {
  ShardRegistry registry(announced(1, 3, "/own"));
  for (const char* name : {"", "/bad name", "relative", "~private", "/a!", "/\n"})
    EXPECT_EQ(
        errorOf([&] { registry.hear(announced(2, 3, name), PROCESS, BEGIN); }),
        "node = '" + std::string(name) + "'; allowed are resolved names of up to 256 letters");
  const std::string longest = "/" + std::string(255, 'a');
  EXPECT_EQ(errorOf([&] { registry.hear(announced(2, 3, longest + "a"), PROCESS, BEGIN); }),
            "node = " + inQuotes(longest) + "; allowed are resolved names of up to 256 letters");
  EXPECT_FALSE(registry.isOpen(2));
  registry.hear(announced(2, 3, longest), PROCESS, BEGIN);
  EXPECT_TRUE(registry.isOpen(2));
}

ShardReply<Pick::Response> reply(std::uint32_t shard, double distance, std::uint8_t error,
                                 const std::string& message) {
  ShardReply<Pick::Response> out;
  out.shard = shard;
  out.response.success = error == ErrorCode::NONE;
  out.response.error_code = error;
  out.response.message = message;
  out.response.distance = distance;
  return out;
}

TEST(ShardMerges, TakeTheNearestUnlessAShardIsSilent) {
  const auto far = reply(0, 7.0, ErrorCode::NONE, "far"),
             near = reply(2, 5.0, ErrorCode::NONE, "near");
  const auto nothing = reply(1, 0.0, ErrorCode::NOTHING_FOUND, "nothing"),
             silent = reply(3, 0.0, ErrorCode::NOT_AVAILABLE, "silent");
  EXPECT_EQ(takeNearest<Pick::Response>({far, nothing, near}).message, "near");
  EXPECT_EQ(takeNearest<Pick::Response>({nothing, nothing}).message, "nothing");
  EXPECT_EQ(takeNearest<Pick::Response>({far, silent, near}).message, "silent");
}

TEST(ShardMerges, JoinMessagesThatDiffer) {
  const auto done = reply(0, 0.0, ErrorCode::NONE, "done"),
             also = reply(1, 0.0, ErrorCode::NONE, "done"),
             silent = reply(2, 0.0, ErrorCode::NOT_AVAILABLE, "silent");
  EXPECT_EQ(joinReplies<Pick::Response>({done, also}).message, "done");
  const auto refused = joinReplies<Pick::Response>({done, silent, also});
  EXPECT_FALSE(refused.success);
  EXPECT_EQ(refused.error_code, ErrorCode::NOT_AVAILABLE);
  EXPECT_EQ(refused.message, "shard 0: done; shard 2: silent; shard 1: done");
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
