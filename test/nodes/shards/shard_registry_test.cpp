// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/shards/shard_registry.h"

#include <gtest/gtest.h>
#include <vegetation_sim/Pick.h>

#include "core/error_text.h"
#include "nodes/shards/shard_merges.h"

namespace vegetation_sim {
namespace {

ShardNode announced(std::uint32_t shard, std::uint32_t shards, const std::string& node) {
  ShardNode out;
  out.shard = shard;
  out.shards = shards;
  out.node = node;
  return out;
}

TEST(ShardRegistry, KnowsTheLatestNodeOfEachShard) {
  ShardRegistry registry({1, 3}, "/own");
  EXPECT_EQ(registry.describeMissing(), "0, 2");
  registry.hear(announced(1, 3, "/own"));
  registry.hear(announced(2, 3, "/first"));
  const auto first = registry.find(2);
  first->overdue = 1;
  EXPECT_EQ(first->node, "/first");
  registry.hear(announced(2, 3, "/second"));
  EXPECT_EQ(registry.find(2)->node, "/second");
  EXPECT_EQ(registry.find(2)->overdue, 0);
  EXPECT_EQ(registry.describeMissing(), "0");
  EXPECT_EQ(errorOf([&] { registry.find(0); }), "shard 0 of 3 is animated by no node");
}

TEST(ShardRegistry, NamesNodesThatDoNotFit) {
  ShardRegistry registry({1, 3}, "/own");
  EXPECT_EQ(errorOf([&] { registry.hear(announced(1, 3, "/other")); }),
            "/other is shard 1 of 3, as this node, /own, is; a shard has one node");
  EXPECT_EQ(errorOf([&] { registry.hear(announced(0, 2, "/other")); }),
            "/other is shard 0 of 2; allowed is a shard from 0 to 2 of 3");
  EXPECT_EQ(errorOf([&] { registry.hear(announced(3, 3, "/other")); }),
            "/other is shard 3 of 3; allowed is a shard from 0 to 2 of 3");
  EXPECT_EQ(registry.describeMissing(), "0, 2");
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
