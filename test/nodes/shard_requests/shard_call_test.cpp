// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/shard_requests/shard_call.h"

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <cstdlib>
#include <future>
#include <memory>
#include <stdexcept>
#include <vector>

#include "sanitized.h"
#include "thread_limit.h"
#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {
namespace {

CallResult resultOf(const std::function<CallResult()>& call) {
  std::promise<CallResult> result;
  startCall(call, [&](CallResult ended) { result.set_value(ended); });
  return result.get_future().get();
}

CallResult callNode(const std::string& node) {
  return callService(
      node + "/owned/grab", [](const std::string&) { return true; }, Repeat::FORBIDDEN);
}

TEST(ShardCall, WhatACallThrowsIsABrokenConnection) {
  EXPECT_EQ(resultOf([] { return CallResult::ANSWERED; }), CallResult::ANSWERED);
  EXPECT_EQ(resultOf([]() -> CallResult { throw std::runtime_error("no such type"); }),
            CallResult::BROKEN);
}

TEST(ShardCall, ANameThatRoscppRefusesIsABrokenConnection) {
  EXPECT_ANY_THROW(callNode("/bad name"));
  EXPECT_EQ(resultOf([] { return callNode("/bad name"); }), CallResult::BROKEN);
  EXPECT_EQ(resultOf([] { return callNode("/nobody"); }), CallResult::NOT_REACHED);
}

TEST(ShardCall, AsManyAsThereCanBeShardsRunAtOnce) {
  std::promise<void> end;
  const std::shared_future<void> ended = end.get_future().share();
  std::vector<std::future<CallResult>> results;
  const auto start = [&] {
    auto result = std::make_shared<std::promise<CallResult>>();
    results.push_back(result->get_future());
    startCall(
        [ended] {
          ended.wait();
          return CallResult::ANSWERED;
        },
        [result](CallResult one) { result->set_value(one); });
  };
  for (int i = 0; i < 256; ++i) start();
  EXPECT_THROW(start(), InvalidInput);
  results.pop_back();
  end.set_value();
  for (std::future<CallResult>& result : results) EXPECT_EQ(result.get(), CallResult::ANSWERED);
  EXPECT_EQ(resultOf([] { return CallResult::ANSWERED; }), CallResult::ANSWERED);
}

// Requests that found no thread are none of those that run.
TEST(ShardCallDeathTest, ACallWithoutAThreadLeavesRoomForOthers) {
  if (SANITIZED) return;                                 // a sanitizer needs the address space
  testing::FLAGS_gtest_death_test_style = "threadsafe";  // no cached stacks
  EXPECT_EXIT(
      {
        exhaustThreads();
        int refused = 0;
        for (int i = 0; i < 300; ++i) try {
            startCall([] { return CallResult::ANSWERED; }, [](CallResult) {});
          } catch (const InvalidInput& error) {
            refused += error.code() == FaultCode::NO_ROOM;
          }
        allowThreads();
        const bool answers = resultOf([] { return CallResult::ANSWERED; }) == CallResult::ANSWERED;
        std::_Exit(refused == 300 && answers ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  ros::init(argc, argv,
            "shard_call_test");  // does not register a node, of which a death test has two
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
