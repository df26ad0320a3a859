// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/replicas/subscribed_replica.h"

#include <gtest/gtest.h>
#include <vegetation_sim/ForestState.h>

#include <new>
#include <stdexcept>

#include "ros/landscape/near_crowd.h"
#include "ros/replicas/subscribed_forest.h"
#include "ros/replicas/subscribed_meadow.h"

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

/// A time in all of the process, as the clock of a simulation sets it.
class TimedReplica : public testing::Test {
 protected:
  static constexpr std::int32_t NOW = 1000;  // [s]
  void SetUp() override {
    ros::Time::init();
    ros::Time::setNow(ros::Time(NOW));
  }
  void TearDown() override { ros::Time::init(); }

  ReplicaOptions options() {
    ReplicaOptions out;
    out.delayed = true;
    out.on_rejected = [this](const std::string&, const std::string& why) { why_ = why; };
    return out;
  }
  template <class Replica, class Message>
  void expectFarRefused(Replica&& replica, const Message& message) {
    const auto why_not = [&](double stamp) {
      Message stamped = message;
      headerOf(stamped).stamp = ros::Time(stamp);
      why_.clear();
      replica.accepts(stamped);
      return why_;
    };
    EXPECT_EQ(why_not(NOW + 61.0), "stamp = 1061.000 s is 61.000 s ahead, allowed are 60 s");
    EXPECT_EQ(why_not(NOW + 3e8).find("stamp = 300001000.000 s is "), 0u);
    EXPECT_EQ(why_not(NOW + 59.0).find("stamp = "), std::string::npos);
  }

 private:
  template <class Message>
  static std_msgs::Header& headerOf(Message& message) {
    return message.header;
  }
  static std_msgs::Header& headerOf(NearGrass& message) { return message.state.header; }

  std::string why_;
};

// States of any size that never become due would fill the memory.
TEST_F(TimedReplica, RefusesStatesThatAreTooFarAheadToWait) {
  expectFarRefused(SubscribedForest(options()), ForestState());
  expectFarRefused(SubscribedMeadow(options()), GrassState());
  expectFarRefused(SubscribedMeadow(options()), NearGrass());
  expectFarRefused(SubscribedCrowd(options()), AgentStates());
  expectFarRefused(NearCrowd(options()), NearAgents());
  expectFarRefused(SubscribedWind(options()), WindField());
}

// The clock may start after the states come.
TEST_F(TimedReplica, AcceptsAnyStampBeforeThereIsATime) {
  ros::Time::setNow(ros::Time());
  AgentStates state;
  state.header.stamp = ros::Time(3e8);
  EXPECT_TRUE(SubscribedCrowd(options()).accepts(state));
}

}  // namespace
}  // namespace vegetation_sim
