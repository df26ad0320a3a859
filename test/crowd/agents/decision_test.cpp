// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/agents/decision.h"

#include <gtest/gtest.h>

#include "reference/crowd/paper_decision.h"
#include "scenes/crowd/crowd_scenes.h"

namespace vegetation_sim::crowd {
namespace {

const Wish EAST{{1.0, 0.0}, 1.3};

View facing(double gap, const Point& normal) {
  View out;
  out.count = 1;
  out.sights[0] = {Seen::STATIC, 0, gap, gap, normal, {}, nullptr, (gap + 0.55) * normal, 0.3};
  return out;
}

CrowdSettings quiet() {
  CrowdSettings out;
  out.behaviour = Behaviour::PAPER;
  out.noise_heading = 0.0;
  return out;
}

// S2-32
TEST(Decision, SlowsDownTheNearerAnObstacleIs) {
  const CrowdSettings settings = quiet();
  double before = 0.0;
  for (double gap = 0.0; gap <= 3.0; gap += 0.1) {
    const double speed = decideByPaper({}, facing(gap, {1, 0}), settings, EAST, 0).speed;
    EXPECT_GE(speed, before);
    before = speed;
  }
  EXPECT_NEAR(decideByPaper({}, facing(0.0, {1, 0}), settings, EAST, 0).speed,
              settings.slowest * EAST.speed, 1e-12);
  EXPECT_EQ(decideByPaper({}, View(), settings, EAST, 0).speed, EAST.speed);
  EXPECT_EQ(decideByPaper({}, View(), settings, EAST, 0).direction.y, 0.0);
}

// S2-32
TEST(Decision, TurnsAwayFromTheObstaclesSide) {
  const CrowdSettings settings = quiet();
  const auto turnOf = [&](double gap, const Point& normal) {
    return decideByPaper({}, facing(gap, normal), settings, EAST, 0).direction.y;
  };
  EXPECT_LT(turnOf(1.0, {0.8, 0.6}), 0.0);   // on the left: to the right
  EXPECT_GT(turnOf(1.0, {0.8, -0.6}), 0.0);  // on the right: to the left
  EXPECT_LT(turnOf(1.0, {1.0, 0.0}), 0.0);   // straight ahead: to the right, always
  EXPECT_LT(turnOf(0.5, {0.8, 0.6}), turnOf(1.5, {0.8, 0.6}));
}

// S2-33, E7: calm at contact, and the printed form the other way round.
TEST(Decision, NoiseGrowsWithTheDistance) {
  CrowdSettings settings;
  EXPECT_EQ(noiseAt(settings, 0.0), 0.0);
  EXPECT_EQ(noiseAt(settings, settings.sensor_range), settings.noise_heading);
  EXPECT_LT(noiseAt(settings, 0.1 * settings.sensor_range), noiseAt(settings, 1.0));
  settings.noise = NoiseLaw::PRINTED;
  EXPECT_GT(noiseAt(settings, 0.1 * settings.sensor_range), noiseAt(settings, 1.0));
  EXPECT_EQ(noiseAt(settings, settings.sensor_range), settings.noise_heading);
  EXPECT_TRUE(std::isfinite(noiseAt(settings, 0.0)));
}

// S2-33, E7: the command's own spread.
TEST(Decision, CommandsNearAnObstacleScatterLess) {
  CrowdSettings settings = quiet();
  settings.noise_heading = 0.2;
  const auto spreadAt = [&](double gap) {
    double sum = 0.0, squares = 0.0;
    constexpr int COUNT = 4000;
    for (int i = 0; i < COUNT; ++i) {
      const Command c = decideByPaper({}, facing(gap, {0.0, 1.0}), settings, EAST, 1000 * i);
      const double angle = arcTangent(c.direction.y, c.direction.x);
      sum += angle / COUNT;
      squares += angle * angle / COUNT;
    }
    return squares - sum * sum;
  };
  const double range = settings.sensor_range;
  EXPECT_NEAR(spreadAt(range - 1e-9), 0.04, 0.004);  // 3 sigma of 4000 draws
  EXPECT_LT(spreadAt(0.1 * range), 0.1 * spreadAt(range - 1e-9));
  settings.noise = NoiseLaw::PRINTED;
  EXPECT_GT(spreadAt(0.1 * range), spreadAt(range - 1e-9));
}

TEST(Decision, NoiseIsNearlyNormal) {
  double sum = 0.0, squares = 0.0, fourths = 0.0;
  constexpr int COUNT = 20000;
  for (std::uint64_t i = 0; i < COUNT; ++i) {
    const double x = normalNumber(9, i);
    sum += x / COUNT;
    squares += x * x / COUNT;
    fourths += x * x * x * x / COUNT;
  }
  EXPECT_NEAR(sum, 0.0, 0.022);     // 3 sigma
  EXPECT_NEAR(squares, 1.0, 0.03);  // likewise
  EXPECT_NEAR(fourths, 2.85, 0.2);  // eight uniform numbers: 3 - 1.2 / 8
}

TEST(Decision, GoalBehaviourKeepsTheSideItTook) {
  CrowdSettings settings;
  settings.noise_heading = 0.0;
  const Obstacle wall = boxObstacle({2.0, 0.0}, 0.1, 0.6, 0.0);
  View view = facing(1.65, {1, 0});
  view.sights[0].obstacle = &wall;
  int side = 0;
  Walker walker;
  const Command right = decideByGoal(walker, view, settings, EAST, 0, side);
  EXPECT_EQ(side, -1);  // the right hand where both are equal
  EXPECT_LT(right.direction.y, -0.1);
  walker.side = 1;  // taken before
  const Command left = decideByGoal(walker, view, settings, EAST, 0, side);
  EXPECT_EQ(side, 1);
  EXPECT_GT(left.direction.y, 0.1);
}

TEST(Decision, StandingWalkersLeaveARobotsWay) {
  CrowdSettings settings;
  settings.noise_heading = 0.0;
  int side = 0;
  const Wish stand{{0.0, 1.0}, 0.0};
  View view = facing(1.4, {-1, 0});
  view.sights[0].kind = Seen::ROBOT;
  view.sights[0].velocity = {1.5, 0.0};
  const Command command = decideByGoal({}, view, settings, stand, 0, side);
  EXPECT_GT(command.speed, 1.0);
  EXPECT_GT(std::fabs(command.direction.y), 0.5);
  view.sights[0].velocity = {-1.5, 0.0};  // it goes away
  EXPECT_EQ(decideByGoal({}, view, settings, stand, 0, side).speed, 0.0);
}

}  // namespace
}  // namespace vegetation_sim::crowd
