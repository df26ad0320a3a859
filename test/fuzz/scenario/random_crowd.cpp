// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/agents/crowd.h"
#include "crowd/body/body_skeleton.h"
#include "fuzz/scenario/simulation.h"
#include "scenes/crowd/crowd_scenes.h"

namespace vegetation_sim::fuzz {
namespace {

constexpr double FARTHEST = 100.0;  // [m] of a walker from the area
constexpr double FASTEST = 20.0;    // [m/s]
constexpr std::size_t MOST = 12;

crowd::CrowdSettings randomSettings(Draw& draw) {
  crowd::CrowdSettings out;
  RandomFields fields(draw, 2.0);
  describe(fields, out);
  return out;
}

crowd::Spawn randomSpawn(Draw& draw) {
  crowd::Spawn out;
  out.position = {draw.between(-6.0, 6.0), draw.between(-6.0, 6.0)};
  RandomFields fields(draw, 1.5);
  describe(fields, out);
  out.wanders = draw.chance(0.5);
  out.has_goal = draw.chance(0.5);
  out.goal = {draw.between(-6.0, 6.0), draw.between(-6.0, 6.0)};
  return out;
}

class RandomCrowd final : public Simulation {
 public:
  RandomCrowd(Draw& draw, int threads)
      : crowd_(draw.key(), randomSettings(draw), {-5.0, 5.0, -5.0, 5.0}, crowd::flatGround()) {
    crowd_.setThreads(threads);
    if (draw.chance(0.5)) crowd_.setObstacles(crowd::room(-5.0, -5.0, 5.0, 5.0));
    for (int walkers = 2 + draw.below(6); walkers > 0; --walkers) spawn(draw);
  }

  void setWind(const wind::Field&) override {}
  void act(Draw& draw, Nanoseconds) override {
    switch (draw.below(6)) {
      case 0:
        return spawn(draw);
      case 1:
        return crowd_.remove(static_cast<std::uint32_t>(draw.below(10)));
      case 2:
        return crowd_.setGoal(static_cast<std::uint32_t>(draw.below(10)),
                              {draw.between(-6.0, 6.0), draw.between(-6.0, 6.0)});
      case 3:
        return crowd_.setSettings(randomSettings(draw));
      default:
        return placeRobot(draw);
    }
  }
  void advance(Nanoseconds stamp, bool, bool) override { crowd_.advance(stamp); }
  void restart() override { crowd_.clear(); }
  void verify() override {
    for (const crowd::Walker& walker : crowd_.walkers()) {
      requireWithin(length(walker.position), FARTHEST, "place of a walker [m]");
      requireWithin(length(walker.velocity), FASTEST, "speed of a walker [m/s]");
      requireWithin(walker.heading, 1e6, "heading of a walker [rad]");
      for (const crowd::Limb& limb : crowd::skeletonOf(walker, crowd_.terrain()))
        requireWithin(limb.to.norm(), FARTHEST + 5.0, "limb [m]");
    }
  }
  std::uint64_t hash() const override { return crowd_.snapshot().hash(); }

 private:
  void spawn(Draw& draw) {
    const crowd::Spawn wanted = randomSpawn(draw);
    if (crowd_.walkers().size() < MOST) crowd_.spawn(wanted);
  }
  void placeRobot(Draw& draw) {
    crowd::Robot robot;
    robot.id = "robot_" + std::to_string(draw.below(2));
    if (draw.chance(0.5)) robot.outline = {{-0.4, -0.3}, {0.4, -0.3}, {0.4, 0.3}, {-0.4, 0.3}};
    robot.radius = draw.between(0.1, 1.0);
    robot.position = {draw.between(-5.0, 5.0), draw.between(-5.0, 5.0)};
    robot.yaw = draw.between(-3.0, 3.0);
    robot.velocity = {draw.between(-2.0, 2.0), draw.between(-2.0, 2.0)};
    crowd_.setRobot(robot);
  }
  crowd::Crowd crowd_;
};

}  // namespace

std::unique_ptr<Simulation> makeCrowd(Draw& draw, int threads) {
  return std::make_unique<RandomCrowd>(draw, threads);
}

}  // namespace vegetation_sim::fuzz
