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
  const double most = 0.15, range = settings.sensor_range;
  EXPECT_EQ(noiseAt(settings, most, 0.0), 0.0);
  EXPECT_EQ(noiseAt(settings, most, range), most);
  EXPECT_LT(noiseAt(settings, most, 0.1 * range), noiseAt(settings, most, 1.0));
  settings.noise = NoiseLaw::PRINTED;
  EXPECT_GT(noiseAt(settings, most, 0.1 * range), noiseAt(settings, most, 1.0));
  EXPECT_EQ(noiseAt(settings, most, range), most);
  EXPECT_TRUE(std::isfinite(noiseAt(settings, most, 0.0)));
}

struct Spread {
  double speed{0.0}, heading{0.0}, together{0.0};  ///< variances, and their correlation
};

// Spread of the commands of 4000 instants, which are farther apart than the smooth noise of GOAL is
// long, beside an obstacle at a distance.
Spread spreadOf(const CrowdSettings& settings, double gap) {
  constexpr int COUNT = 4000;
  double v = 0.0, vv = 0.0, a = 0.0, aa = 0.0, va = 0.0;
  for (int i = 0; i < COUNT; ++i) {
    const Nanoseconds stamp = fromSeconds(5.217) * i;
    int side = 0;
    const View view = facing(gap, {0.0, 1.0});
    const Command c = settings.behaviour == Behaviour::PAPER
                          ? decideByPaper({}, view, settings, EAST, stamp)
                          : decideByGoal({}, view, settings, EAST, stamp, side);
    const double angle = arcTangent(c.direction.y, c.direction.x);
    v += c.speed / COUNT;
    vv += c.speed * c.speed / COUNT;
    a += angle / COUNT;
    aa += angle * angle / COUNT;
    va += c.speed * angle / COUNT;
  }
  Spread out{vv - v * v, aa - a * a, va - v * a};
  out.together /= std::sqrt(std::max(1e-30, out.speed * out.heading));
  return out;
}

// S2-33: the noise is on speed and heading, each with a draw of its own, and grows with the
// distance of the nearest obstacle.
TEST(Decision, TheSpeedScattersToo) {
  for (const Behaviour behaviour : {Behaviour::PAPER, Behaviour::GOAL}) {
    CrowdSettings settings = quiet();
    settings.behaviour = behaviour;
    EXPECT_NEAR(spreadOf(settings, 2.9).speed, 0.0, 1e-12);
    settings.noise_speed = 0.2;
    settings.noise_heading = 0.2;
    const Spread far = spreadOf(settings, settings.sensor_range - 1e-9);
    // The smooth noise of GOAL counts as 0.3, but it deviates by the root of 0.0792.
    const double part = behaviour == Behaviour::PAPER ? 1.0 : 0.0792 / 0.09;
    const double expected = part * 0.2 * EAST.speed * 0.2 * EAST.speed;
    EXPECT_NEAR(far.speed, expected, 0.1 * expected);
    EXPECT_NEAR(far.heading, part * 0.04, part * 0.004);
    EXPECT_NEAR(far.together, 0.0, 0.06);  // 4 sigma
    EXPECT_LT(spreadOf(settings, 0.3).speed, 0.1 * expected);
  }
}

TEST(Decision, NoSpeedIsReversedByItsNoise) {
  EXPECT_EQ(noisySpeed(1.2, -3.0), 0.0);
  EXPECT_EQ(noisySpeed(1.2, 7.0), 2.4);
  EXPECT_EQ(noisySpeed(1.2, 0.0), 1.2);
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

// S2-33: a setting of the speed's noise is part of the state, and 0 leaves states as they were.
TEST(Decision, NoiseOfTheSpeedChangesTheHashOnlyIfThereIsAny) {
  CrowdSettings settings;
  const std::uint64_t without = crowdedRoom(1, settings).snapshot().hash();
  settings.noise_speed = 0.1;
  Crowd noisy = crowdedRoom(1, settings), quiet = crowdedRoom(1, CrowdSettings());
  EXPECT_NE(noisy.snapshot().hash(), without);
  EXPECT_EQ(Crowd::readArchived(noisy.archived()).settings.noise_speed, 0.1);
  run(noisy, 2.0, 1.0 / 30.0);
  run(quiet, 2.0, 1.0 / 30.0);
  EXPECT_GT(length(noisy.walkers()[0].position - quiet.walkers()[0].position), 0.01);
}

}  // namespace
}  // namespace vegetation_sim::crowd
