// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/replicas/subscribed_replica.h"

#include <gtest/gtest.h>
#include <vegetation_sim/ForestState.h>

#include <new>
#include <stdexcept>

namespace vegetation_sim {
namespace {

// A replica whose messages throw what the test wants.
struct ThrowingReplica : SubscribedReplica<ForestState> {
  using SubscribedReplica::SubscribedReplica;
  void apply(const ForestState& message) override { accepts(message); }
  bool accepts(const ForestState&) override {
    return receive("forest/state", status, [this]() -> InputStatus {
      if (raise) raise();
      return {true, "In step"};
    });
  }
  std::function<void()> raise;
  InputStatus status;
};

// Callbacks run in the threads of others: what a message throws must not end them.
TEST(SubscribedReplica, AnyExceptionRejectsItsMessageOnly) {
  std::vector<std::string> rejected;
  ReplicaOptions options;
  options.on_rejected = [&](const std::string& input, const std::string& why) {
    rejected.push_back(input + ": " + why);
  };
  ThrowingReplica replica(options);
  for (const std::function<void()>& raise :
       {std::function<void()>([] { throw std::out_of_range("branch = 7"); }),
        std::function<void()>([] { throw std::bad_alloc(); })}) {
    replica.raise = raise;
    EXPECT_FALSE(replica.accepts({}));
    EXPECT_FALSE(replica.status.good);
  }
  replica.raise = nullptr;
  EXPECT_TRUE(replica.accepts({}));
  EXPECT_TRUE(replica.status.good);
  ASSERT_EQ(rejected.size(), 2u);
  EXPECT_EQ(rejected[0], "forest/state: branch = 7");
}

}  // namespace
}  // namespace vegetation_sim
