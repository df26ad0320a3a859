// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/body/body_skeleton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <utility>
#include <vector>

#include "crowd/agents/crowd_scene.h"
#include "scenes/crowd/crowd_scenes.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::crowd {
namespace {

constexpr double DT = 1.0 / 60.0, SPEED = 1.1;

// A plane that rises to the east.
terrain::HeightMap slope(double rise) {
  terrain::HeightMapLaw law;
  law.resolution = 100.0;
  law.origin = Vec3(-50, -50, -50.0 * rise);
  law.height_max = 100.0 * rise;
  terrain::GreyImage image;
  image.columns = image.rows = 2;
  image.samples = {0, 255, 0, 255};
  return terrain::HeightMap(law, image);
}

struct Instant {
  Walker walker;
  Skeleton body;
};

// Walks straight ahead for six seconds. Returns the last four.
std::vector<Instant> walk(double heading, const terrain::HeightMap& ground) {
  std::vector<Instant> out;
  Walker w;
  w.heading = heading;
  const SinCos turn = sinCos(heading);
  w.velocity = {SPEED * turn.cos, SPEED * turn.sin};
  for (int i = 0; i < 360; ++i) {
    w.position = w.position + DT * w.velocity;
    advanceGait(SPEED * DT, w);
    if (i >= 120) out.push_back({w, skeletonOf(w, ground)});
  }
  return out;
}

// Distance of a place from the ground, along its normal [m].
double clearance(const Vec3& place, const terrain::HeightMap& ground) {
  const Vec3 foot(place.x(), place.y(), ground.height(place.x(), place.y()));
  return dot(place - foot, ground.normal(place.x(), place.y()));
}

Vec3 trunkOf(const Instant& instant) {
  const Limb& neck = limbOf(instant.body, Part::NECK);
  const Vec3 along = neck.to - neck.from;
  return along / length(along);
}

// S2-34: feet lie on a slope, roll on it and swing over it as on flat ground.
TEST(BodySkeleton, FeetFollowTheSlope) {
  const terrain::HeightMap flat, steep = slope(0.35);
  for (const double heading : {0.0, PI}) {
    const std::vector<Instant> expected = walk(heading, flat), found = walk(heading, steep);
    for (std::size_t i = 0; i < found.size(); ++i)
      for (int side = 0; side < 2; ++side) {
        const Limb& on_flat = limbOf(expected[i].body, Part::FOOT, side);
        const Limb& on_slope = limbOf(found[i].body, Part::FOOT, side);
        ASSERT_NEAR(clearance(on_slope.from, steep), on_flat.from.z(), 1e-6) << heading << " " << i;
        ASSERT_NEAR(clearance(on_slope.to, steep), on_flat.to.z(), 1e-6) << heading << " " << i;
      }
  }
}

// S2-34: each planted foot is at the height of its own ground, and both legs reach.
TEST(BodySkeleton, EachFootStandsAtTheHeightOfItsOwnGround) {
  const terrain::HeightMap steep = slope(0.35);
  double apart = 0.0;
  for (const double heading : {0.0, 0.5 * PI, 2.2, PI, -0.5 * PI})
    for (const Instant& instant : walk(heading, steep)) {
      const Limb* feet[2];
      for (int side = 0; side < 2; ++side) {
        const Limb& foot = *(feet[side] = &limbOf(instant.body, Part::FOOT, side));
        const Limb& thigh = limbOf(instant.body, Part::THIGH, side);
        const Limb& shank = limbOf(instant.body, Part::SHANK, side);
        const double lowest = std::min(clearance(foot.from, steep), clearance(foot.to, steep));
        const bool stands = instant.walker.feet[static_cast<std::size_t>(side)].stands;
        ASSERT_TRUE(!stands || std::fabs(lowest - foot.radius) < 0.01) << heading << " " << lowest;
        const double h = instant.walker.height;
        ASSERT_NEAR(length(thigh.to - thigh.from), Proportions::THIGH * h, 0.02) << heading;
        ASSERT_NEAR(length(shank.to - shank.from), Proportions::SHANK * h, 0.02) << heading;
      }
      if (heading == 0.5 * PI)  // the slope rises to the right
        apart = std::max(apart, feet[1]->to.z() - feet[0]->to.z());
    }
  EXPECT_GT(apart, 0.35 * 2.0 * Proportions::HIP_HALF * 1.75);
}

// S2-34: the trunk is upright but for a lean of 0.3 of the slope along the way, and never sideways.
TEST(BodySkeleton, TrunksLeanIntoTheSlope) {
  const terrain::HeightMap flat, steep = slope(0.35);
  const auto leanOf = [&](double heading, const terrain::HeightMap& ground) {
    const SinCos turn = sinCos(heading);
    const Vec3 trunk = trunkOf(walk(heading, ground).back());
    EXPECT_NEAR(turn.cos * trunk.y() - turn.sin * trunk.x(), 0.0, 1e-9) << heading;
    return arcTangent(turn.cos * trunk.x() + turn.sin * trunk.y(), trunk.z());
  };
  const double upright = leanOf(0.0, flat), expected = 0.3 * arcTangent(0.35, 1.0);
  EXPECT_NEAR(leanOf(0.0, steep), upright + expected, 1e-6);
  EXPECT_NEAR(leanOf(PI, steep), upright - expected, 1e-6);
  EXPECT_NEAR(leanOf(0.5 * PI, steep), upright, 1e-6);
}

// Feet of people who turn, stop and give way stay near below them, so that nobody squats down.
TEST(BodySkeleton, WanderersStayUpright) {
  Crowd crowd(1, {}, {-15, 15, -15, 15}, flatGround());
  for (const Spawn& spawn : groupOf({}, 150, 15.0, 0.2, Random(1))) crowd.spawn(spawn);
  double lowest = 1.0;
  for (int tick = 1; tick <= 1200; ++tick) {
    crowd.advance(fromSeconds(DT * tick));
    for (const Walker& walker : crowd.walkers()) {
      const Skeleton body = skeletonOf(walker, crowd.terrain());
      const Limb& pelvis = limbOf(body, Part::PELVIS);
      lowest = std::min(lowest, 0.5 * (pelvis.from.z() + pelvis.to.z()) / walker.height);
    }
  }
  std::cout << "lowest pelvis: " << lowest << " of the height\n";
  EXPECT_GT(lowest, 0.4);
}

// S2-34: on slopes of 60 degrees, and where they begin and end, people hardly get on, but limbs
// keep their lengths and nobody sinks into the ground.
TEST(BodySkeleton, PeopleStandOnSlopesOf60Degrees) {
  const auto hillside = std::make_shared<terrain::HeightMap>(slope(std::tan(PI / 3.0)));
  Crowd crowd(1, {}, {-15, 15, -15, 15}, hillside);
  for (const Spawn& spawn : groupOf({}, 60, 15.0, 0.2, Random(1))) crowd.spawn(spawn);
  double lowest = 1.0, farthest = 0.0, longest = 0.0;
  std::vector<Point> starts;
  for (const Walker& walker : crowd.walkers()) starts.push_back(walker.position);
  for (int tick = 1; tick <= 600; ++tick) {
    crowd.advance(fromSeconds(DT * tick));
    for (const Walker& walker : crowd.walkers()) {
      const Skeleton body = skeletonOf(walker, *hillside);
      for (int side = 0; side < 2; ++side)
        for (const auto& [part, share] : {std::pair(Part::THIGH, Proportions::THIGH),
                                          std::pair(Part::SHANK, Proportions::SHANK)}) {
          const Limb& limb = limbOf(body, part, side);
          longest =
              std::max(longest, std::fabs(length(limb.to - limb.from) - share * walker.height));
        }
      const Limb& pelvis = limbOf(body, Part::PELVIS);
      const Vec3 middle = 0.5 * (pelvis.from + pelvis.to);
      lowest =
          std::min(lowest, (middle.z() - hillside->height(middle.x(), middle.y())) / walker.height);
    }
  }
  for (std::size_t i = 0; i < starts.size(); ++i)
    farthest = std::max(farthest, length(crowd.walkers()[i].position - starts[i]));
  std::cout << "lowest pelvis: " << lowest << " of the height; limbs longer by " << longest
            << " m; farthest way " << farthest << " m in 10 s\n";
  EXPECT_GT(lowest, 0.1);
  EXPECT_LT(longest, 0.02);
  EXPECT_LT(farthest, 15.0);
}

}  // namespace
}  // namespace vegetation_sim::crowd
