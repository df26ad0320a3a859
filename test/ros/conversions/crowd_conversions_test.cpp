// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/conversions/crowd_conversions.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/error_text.h"

namespace vegetation_sim {
namespace {

AgentState standing(std::uint32_t id) {
  AgentState out;
  out.id = id;
  out.height = 1.7;
  out.pose.orientation.w = 1.0;
  return out;
}

// Invalid walkers in a message are rejected with an error that names walker, field, value and
// range.
TEST(CrowdConversions, RejectInvalidWalkers) {
  constexpr double NONE = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<std::string, std::function<void(AgentState&)>>> faults = {
      {"position", [](AgentState& a) { a.pose.position.y = NONE; }},
      {"height = 9 m is outside 0.1 to 5 m", [](AgentState& a) { a.height = 9.0; }},
      {"gait", [](AgentState& a) { a.gait = NONE; }},
      {"velocity", [](AgentState& a) { a.velocity.x = 1e9; }},
      {"orientation, its norm, = 2", [](AgentState& a) { a.pose.orientation.w = 2.0; }},
      {"feet", [](AgentState& a) { a.feet[1].z = NONE; }},
      {"feet_lag", [](AgentState& a) { a.feet_lag[0].x = -NONE; }}};
  AgentStates message;
  message.agents = {standing(3), standing(7)};
  EXPECT_EQ(errorOf([&] { check(message); }), "");
  for (const auto& [text, spoil] : faults) {
    AgentStates bad = message;
    spoil(bad.agents[1]);
    const std::string refusal = errorOf([&] { check(bad); });
    EXPECT_NE(refusal.find("agent 7: "), std::string::npos) << text;
    EXPECT_NE(refusal.find(text), std::string::npos) << refusal;
    EXPECT_EQ(refusal.find("agent 3"), std::string::npos) << refusal;
  }
}

TEST(CrowdConversions, AGoalWithoutItsFlagIsRejectedByName) {
  AgentSpawn message;
  message.has_goal = true;
  message.goal.x = 2.0;
  Faults none;
  EXPECT_EQ(fromMsg(message, "like: ", none).goal.x, 2.0);
  EXPECT_TRUE(none.empty());
  message.has_goal = false;
  for (const double z : {0.0, 1.0, std::numeric_limits<double>::quiet_NaN()}) {
    message.goal.x = z == 0.0 ? 2.0 : 0.0;
    message.goal.z = z;
    Faults faults;
    fromMsg(message, "like: ", faults);
    EXPECT_EQ(errorOf([&] { faults.throwIfAny(); }), "like: goal needs has_goal = true");
  }
}

TEST(CrowdConversions, AWalkerWithoutAGoalIsSentWithoutOne) {
  crowd::Spawn spawn;
  spawn.goal = {3.0, 4.0};
  EXPECT_EQ(toMsg(spawn).goal.x, 0.0);
  spawn.has_goal = true;
  EXPECT_EQ(toMsg(spawn).goal.x, 3.0);
}

}  // namespace
}  // namespace vegetation_sim
