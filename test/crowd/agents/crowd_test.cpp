// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/agents/crowd.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error_text.h"
#include "crowd/body/gait.h"
#include "scenes/crowd/crowd_scenes.h"

namespace vegetation_sim::crowd {
namespace {

constexpr double TICK = 1.0 / 30.0;
constexpr double NONE = std::numeric_limits<double>::quiet_NaN();

bool allArriveWithin(Crowd& crowd, double seconds) {
  bool all = false;
  for (int i = 0; i < static_cast<int>(seconds) && !all; ++i) {
    run(crowd, 1.0, TICK);
    all = allArrived(crowd);
  }
  return all;
}

// Part 4: real radii, no walking through walls or people, at any step.
TEST(Crowd, NothingIsPenetratedAtAnyStep) {
  for (const double dt : {1.0 / 60.0, 0.1, 0.5, 2.0, 10.0}) {
    Crowd crowd = crowdedRoom(4, CrowdSettings());
    run(crowd, std::max(20.0, 40.0 * dt), dt, [&](const Crowd& c) {
      ASSERT_LT(c.deepestOverlap(), 1e-9) << dt;
      for (const Walker& w : c.walkers()) ASSERT_LT(std::fabs(w.position.x), 4.7) << dt;
    });
  }
}

/// Mean speed of the walkers of a crowd over steps in which they walk [m/s].
struct MeanSpeed {
  double sum{0.0};
  int steps{0};
  void add(double speed) {
    sum += speed;
    ++steps;
  }
  double get() const { return sum / steps; }
};

// S2-30: ten minutes on a slope that rises to the east; no walker leaves the walls or overlaps, and
// all move, slower up the slope than down.
TEST(Crowd, TenMinutesBetweenVirtualWallsOnASlope) {
  Crowd crowd = crowdedRoom(2, CrowdSettings(), risingGround(0.2));
  std::vector<double> way(10, 0.0);
  MeanSpeed up, down;
  run(crowd, 600.0, 0.1, [&](const Crowd& c) {
    ASSERT_LT(c.deepestOverlap(), 1e-9);
    for (std::size_t i = 0; i < 10; ++i) {
      const Walker& w = c.walkers()[i];
      ASSERT_LT(std::max(std::fabs(w.position.x), std::fabs(w.position.y)), 4.7);
      const double speed = length(w.velocity);
      way[i] += 0.1 * speed;
      if (speed > 0.3 && std::fabs(w.velocity.x) > 0.8 * speed)
        (w.velocity.x > 0.0 ? up : down).add(speed);
    }
  });
  for (const double metres : way) EXPECT_GT(metres, 60.0);
  ASSERT_GT(std::min(up.steps, down.steps), 1000);
  EXPECT_LT(up.get(), 0.9 * down.get());
}

// S2-32
TEST(Crowd, HeadOnPairsPass) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Crowd crowd = headOn(seed, CrowdSettings());
    EXPECT_TRUE(allArriveWithin(crowd, 30.0)) << seed;
  }
  CrowdSettings quiet;
  quiet.noise_heading = 0.0;
  Crowd exact = headOn(0, quiet);
  run(exact, 3.6, TICK);                           // side by side
  EXPECT_LT(exact.walkers()[0].position.y, -0.1);  // each to its right
  EXPECT_GT(exact.walkers()[1].position.y, 0.1);
  EXPECT_TRUE(allArriveWithin(exact, 30.0));
}

TEST(Crowd, CirclesCross) {
  Crowd crowd = circle(20, 8.0, 1, CrowdSettings());
  EXPECT_TRUE(allArriveWithin(crowd, 60.0));
}

TEST(Crowd, TrapsAreLeft) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Crowd crowd = trap(seed, 4.0, CrowdSettings());
    EXPECT_TRUE(allArriveWithin(crowd, 90.0)) << seed;
  }
  // The nearest obstacle alone leads no walker out.
  CrowdSettings paper;
  paper.behaviour = Behaviour::PAPER;
  paper.neighbours = 1;
  Crowd crowd = trap(0, 4.0, paper);
  EXPECT_FALSE(allArriveWithin(crowd, 90.0));
}

TEST(Crowd, TwoStreamsPassInACorridor) {
  Crowd crowd = corridor(3.0, 1, CrowdSettings());
  std::vector<double> start;
  for (const Walker& w : crowd.walkers()) start.push_back(w.position.x);
  run(crowd, 15.0, TICK);
  double share = 0.0;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const Walker& w = crowd.walkers()[i];
    share += std::fabs(w.position.x - start[i]) / (15.0 * w.speed) / 20.0;
  }
  EXPECT_GT(share, 0.5);
}

// Part 4: the live pose of the robot counts, not where it was first.
TEST(Crowd, RobotsDriveThroughWithoutTouchingAnybody) {
  Crowd crowd(5, CrowdSettings(), {-8, 8, -8, 8}, flatGround());
  const Random random(8);
  for (std::uint64_t i = 0; i < 30; ++i) {
    Spawn spawn;
    spawn.position = {random.uniform(2 * i, -7.0, 7.0), random.uniform(2 * i + 1, -7.0, 7.0)};
    spawn.wanders = i % 3 != 0;  // some stand
    crowd.spawn(spawn);
  }
  run(crowd, 2.0, TICK);
  Robot robot;
  robot.id = "base_link";
  robot.outline = {{0.5, 0.35}, {-0.5, 0.35}, {-0.5, -0.35}, {0.5, -0.35}};
  robot.velocity = {1.5, 0.0};
  double deepest = 0.0;
  for (int pass = 0; pass < 4; ++pass) {
    for (int i = 0; i < 400; ++i) {
      robot.position = {-10.0 + 1.5 * TICK * i, -3.0 + 2.0 * pass};
      crowd.setRobot(robot);
      crowd.advance(crowd.snapshot().stamp + fromSeconds(TICK));
      deepest = std::max(deepest, crowd.deepestOverlap());
    }
  }
  EXPECT_LT(deepest, 1e-9);
}

TEST(Crowd, OverlapsAreLeftFast) {
  Crowd crowd(1, CrowdSettings(), {-5, 5, -5, 5}, flatGround());
  crowd.setObstacles({discObstacle({0, 0}, 0.5), boxObstacle({4, 0}, 0.8, 0.4, 0.3)});
  for (int i = 0; i < 6; ++i) {
    Spawn spawn;
    spawn.wanders = false;
    spawn.position = i < 4 ? Point{0.1, 0.0} : Point{4.1, 0.1};
    crowd.spawn(spawn);
  }
  EXPECT_GT(crowd.deepestOverlap(), 0.4);
  run(crowd, 3.0, TICK);
  EXPECT_LT(crowd.deepestOverlap(), 1e-9);
}

// N6: one structure; the same inputs, the same bits, on any number of threads.
TEST(Crowd, SameHashForAnyNumberOfThreads) {
  std::uint64_t hashes[3];
  const int threads[3] = {1, 2, 5};
  for (int k = 0; k < 3; ++k) {
    Crowd crowd(9, CrowdSettings(), {0, 60, 0, 60}, flatGround());
    crowd.setThreads(threads[k]);
    for (std::uint64_t i = 0; i < 1500; ++i) {
      Spawn spawn;
      spawn.position = {Random(3).uniform(2 * i, 0.0, 60.0),
                        Random(3).uniform(2 * i + 1, 0.0, 60.0)};
      crowd.spawn(spawn);
    }
    run(crowd, 1.0, TICK);
    hashes[k] = crowd.snapshot().hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(Crowd, GoesOnFromASavedMemory) {
  Crowd first = crowdedRoom(6, CrowdSettings()), second = crowdedRoom(1, CrowdSettings());
  run(first, 5.0, TICK);
  const CrowdSnapshot saved = first.snapshot();
  run(first, 5.0, TICK);
  second.restore(saved);
  run(second, 5.0, TICK);
  EXPECT_EQ(first.snapshot().hash(), second.snapshot().hash());
  EXPECT_NE(first.snapshot().hash(), saved.hash());
}

// The lengths of lists are checked before they are read; nothing follows the walkers here.
TEST(Crowd, ReadsTheBytesOfAnyNumberOfWalkers) {
  Crowd crowd(6, CrowdSettings(), {-8, 8, -8, 8}, flatGround());
  for (int count = 0; count < 20; ++count) {
    EXPECT_EQ(Crowd::readArchived(crowd.archived()).hash(), crowd.snapshot().hash()) << count;
    crowd.spawn(Spawn());
  }
}

TEST(Crowd, SeedsMakeCrowds) {
  Crowd first = crowdedRoom(6, CrowdSettings()), same = crowdedRoom(6, CrowdSettings());
  Crowd other = crowdedRoom(7, CrowdSettings());
  for (Crowd* crowd : {&first, &same, &other}) run(*crowd, 5.0, TICK);
  EXPECT_EQ(first.snapshot().hash(), same.snapshot().hash());
  EXPECT_NE(first.snapshot().hash(), other.snapshot().hash());
}

double meanSpeed(const std::shared_ptr<const terrain::HeightMap>& ground, const Point& goal,
                 double grass) {
  CrowdSettings settings;
  settings.noise_heading = 0.0;
  Crowd crowd(1, settings, {-40, 40, -40, 40}, ground);
  if (grass > 0.0) crowd.setResistance([grass](const Point&) { return grass; });
  spawnAt(crowd, {0, 0}, goal);
  run(crowd, 10.0, TICK);
  return length(crowd.walkers()[0].position) / 10.0;
}

// S2-34, S2-37: the ground is felt.
TEST(Crowd, SlopesAndGrassSlowDown) {
  const double flat = meanSpeed(flatGround(), {30, 0}, 0.0);
  EXPECT_NEAR(flat, 1.35, 0.1);
  EXPECT_LT(meanSpeed(risingGround(0.2), {30, 0}, 0.0), 0.65 * flat);    // up
  EXPECT_GT(meanSpeed(risingGround(0.05), {-30, 0}, 0.0), 1.05 * flat);  // gently down
  EXPECT_NEAR(meanSpeed(risingGround(0.2), {0, 30}, 0.0), flat, 0.02);   // along
  EXPECT_NEAR(meanSpeed(flatGround(), {30, 0}, 1.0), 0.4 * flat, 0.1 * flat);
}

// S2-36: footprints are a stride apart, left and right of the track.
TEST(Crowd, FeetComeDownAStrideApart) {
  CrowdSettings settings;
  settings.noise_heading = 0.0;
  Crowd crowd(1, settings, {-40, 40, -40, 40}, flatGround());
  spawnAt(crowd, {0, 0}, {30, 0});
  std::vector<Point> prints;
  bool stood = true;
  run(crowd, 12.0, TICK, [&](const Crowd& c) {
    const Walker& w = c.walkers()[0];
    if (w.feet[0].stands && !stood) prints.push_back(w.feet[0].planted);
    stood = w.feet[0].stands;
  });
  ASSERT_GT(prints.size(), 6U);
  for (std::size_t i = 4; i < prints.size(); ++i) {
    EXPECT_NEAR(prints[i].x - prints[i - 1].x, strideLength(1.35, 1.75), 0.06);
    EXPECT_NEAR(prints[i].y, Proportions::HIP_HALF * 1.75, 0.02);
  }
}

TEST(Crowd, RejectsInvalidInputs) {
  Crowd crowd = crowdedRoom(1, CrowdSettings());
  const std::uint64_t before = crowd.snapshot().hash();
  Spawn spawn;
  spawn.position.x = NONE;
  spawn.speed = 99.0;
  EXPECT_NE(errorOf([&] { crowd.spawn(spawn); }).find("speed = 99 m/s is outside 0.1 to 3"),
            std::string::npos);
  EXPECT_NE(errorOf([&] { crowd.spawn(spawn); }).find("x = "), std::string::npos);
  EXPECT_NE(errorOf([&] { crowd.remove(77); }).find("walker 77 is unknown"), std::string::npos);
  EXPECT_NE(errorOf([&] { crowd.setGoal(77, {0, 0}); }).find("77"), std::string::npos);
  EXPECT_NE(errorOf([&] { crowd.setGoal(1, {NONE, 0}); }).find("goal: x"), std::string::npos);
  EXPECT_NE(errorOf([&] {
              crowd.setGoal(1, {30, 0});
            }).find("no way leads there"),
            std::string::npos);
  Robot robot;
  robot.id = "cart";
  robot.position.x = NONE;
  robot.outline = {{0, 0}, {1, 0}};
  const std::string text = errorOf([&] { crowd.setRobot(robot); });
  EXPECT_NE(text.find("robot 'cart': x = nan"), std::string::npos) << text;
  EXPECT_NE(text.find("2 corners"), std::string::npos) << text;
  EXPECT_NE(errorOf([&] { crowd.removeRobot("cart"); }).find("cart"), std::string::npos);
  CrowdSettings settings;
  settings.sensor_range = 0.0;
  EXPECT_NE(errorOf([&] { crowd.setSettings(settings); }).find("sensor_range = 0 m"),
            std::string::npos);
  EXPECT_EQ(crowd.snapshot().hash(), before);
}

TEST(Crowd, TakesNoMoreThanItsMost) {
  Crowd crowd(1, CrowdSettings(), {-5, 5, -5, 5}, flatGround());
  Spawn spawn;
  for (std::size_t i = 0; i < MOST_WALKERS; ++i) crowd.spawn(spawn);
  EXPECT_NE(errorOf([&] { crowd.spawn(spawn); }).find("100000"), std::string::npos);
  crowd.clear();
  EXPECT_EQ(crowd.spawn(spawn), 0U);
}

// Walls that cross are walls.
TEST(Crowd, CrossingWallsAreWalls) {
  Crowd crowd(3, CrowdSettings(), {-3, 3, -3, 3}, flatGround());
  crowd.setObstacles({wallObstacle({-4, -4}, {4, 4}, 0.1), wallObstacle({-4, 4}, {4, -4}, 0.1)});
  Spawn spawn;
  spawn.position = {2.0, 0.0};
  crowd.spawn(spawn);
  run(crowd, 60.0, 0.1, [&](const Crowd& c) { ASSERT_LT(c.deepestOverlap(), 1e-9); });
}

TEST(Crowd, MovesNoWalkerWhileTimeStands) {
  Crowd crowd = crowdedRoom(1, CrowdSettings());
  run(crowd, 1.0, TICK);
  const std::uint64_t before = crowd.snapshot().hash();
  crowd.advance(crowd.snapshot().stamp);
  crowd.advance(crowd.snapshot().stamp - 5);
  EXPECT_EQ(crowd.snapshot().hash(), before);
}

}  // namespace
}  // namespace vegetation_sim::crowd
