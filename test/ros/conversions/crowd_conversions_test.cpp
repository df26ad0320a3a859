// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/conversions/crowd_conversions.h"

#include <gtest/gtest.h>

#include <ctime>
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

/// A layout whose trees all stand in tiles side by side: a few hundred bytes.
forest::Layout tiledLayout(std::uint32_t tiles, std::uint32_t trees_per_tile) {
  forest::Layout out;
  out.species.resize(1);
  forest::Tile tile;
  tile.count = trees_per_tile;
  tile.size = 1000.0;
  tile.mix = {1.f};
  for (std::uint32_t i = 0; i < tiles; ++i) {
    tile.first_tree = i * trees_per_tile;
    tile.x = i * tile.size;
    tile.seed = i;
    out.tiles.push_back(tile);
  }
  return out;
}

TEST(CrowdConversions, TrunksAreThoseOfAllTreesInTheAreaAndNoOthers) {
  const forest::Layout layout = tiledLayout(2, 20000);
  const crowd::Area area{900.0, 1100.0, 300.0, 400.0};
  std::size_t expected = 0;
  for (const forest::Tile& tile : layout.tiles)
    for (std::uint32_t i = 0; i < tile.count; ++i) {
      const Vec3 at = seedInTile(tile, i).position;
      expected += at.x() >= area.min_x && at.x() <= area.max_x && at.y() >= area.min_y &&
                  at.y() <= area.max_y;
    }
  EXPECT_GT(expected, 100u);
  EXPECT_EQ(trunksOf(layout, TrunkShape::ROUND, area, 0.0, 100000).size(), expected);
  EXPECT_EQ(trunksOf(layout, TrunkShape::ROUND, area, 0.0, 7).size(), 7u);
}

// To visit each of the 2^24 trees takes 2.5 s, in which a node does not run its ticks. The limit is
// that of one input of a fuzz target.
TEST(CrowdConversions, TrunksOfMillionsOfTreesTakeNoTime) {
  const forest::Layout layout = tiledLayout(64, 1 << 18);
  const crowd::Area area{500.0, 520.0, 500.0, 520.0};
  const std::clock_t start = std::clock();
  const std::size_t trunks = trunksOf(layout, TrunkShape::ROUND, area, 1.0, 100000).size();
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 0.05);
  EXPECT_GT(trunks, 50u);
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
  EXPECT_EQ(errorOf([&] { check(message.agents); }), "");
  for (const auto& [text, spoil] : faults) {
    AgentStates bad = message;
    spoil(bad.agents[1]);
    const std::string refusal = errorOf([&] { check(bad.agents); });
    EXPECT_NE(refusal.find("agent 7: "), std::string::npos) << text;
    EXPECT_NE(refusal.find(text), std::string::npos) << refusal;
    EXPECT_EQ(refusal.find("agent 3"), std::string::npos) << refusal;
  }
}

TEST(CrowdConversions, DiscsAreReadAsTheyWereWritten) {
  const std::vector<InterestArea> discs = {{1.0, -2.0, 30.0}, {1e6, 0.0, 1e9}};
  EXPECT_EQ(fromMsg(toMsg(discs)), discs);
  std::vector<InterestDisc> bad = toMsg(discs);
  bad[1].radius = -1.0;
  EXPECT_NE(errorOf([&] { fromMsg(bad); }).find("discs[1].radius = -1 m is outside 0 to 2e+09 m"),
            std::string::npos)
      << errorOf([&] { fromMsg(bad); });
  EXPECT_EQ(errorOf([&] { fromMsg(std::vector<InterestDisc>(65)); }),
            "discs has 65 entries, allowed are 64");
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
