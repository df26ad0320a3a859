// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/sky_view.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "reference/sensors/open_rays.h"
#include "scenes/sensors/grove_scene.h"
#include "scenes/sensors/lidar_scene.h"
#include "vegetation_sim/core/config/instruction_set.h"

namespace vegetation_sim::scan {
namespace {

constexpr double SKY_REACH = 60.0;
ThreadPool one_thread;

forest::TreeSeed oakAt(double x, double y, std::uint64_t seed) {
  forest::TreeSeed out;
  out.position = Vec3(x, y, 0.0);
  out.seed = seed;
  return out;
}

// Twelve oaks around a clearing.
Scene oaks(const wind::Field& wind, double after) {
  forest::Layout layout;
  layout.species.push_back(forest::shippedSpecies("oak"));
  for (std::uint64_t i = 0; i < 12; ++i) {
    const SinCos turn = sinCosTurns(static_cast<double>(i) / 12.0);
    layout.trees.push_back(oakAt(11.0 * turn.cos, 11.0 * turn.sin, 100 + i));
  }
  Scene out;
  out.trees.update(movingForest(layout, wind), Vec3::Zero(), SKY_REACH, START + fromSeconds(after));
  return out;
}
const Vec3 UNDER_AN_OAK(9.5, 0.7, 1.2), IN_THE_CLEARING(0.0, 0.0, 1.2);

// Returns the root of the mean squared difference of the bins.
double differenceOfBins(const SkyTransmittance& a, const SkyTransmittance& b) {
  double sum = 0.0;
  for (std::size_t bin = 0; bin < SKY_BINS; ++bin) {
    const double difference = a.bins[bin] - b.bins[bin];
    sum += difference * difference;
  }
  return std::sqrt(sum / SKY_BINS);
}

/// @param of_bins limit of differenceOfBins().
void expectAsCounted(const Scene& scene, const Vec3& place, const char* name, double of_bins) {
  const SkyTransmittance sky = viewSky(scene, place, SKY_REACH, one_thread);
  const SkyTransmittance counted = countOpenRays(scene, place, SKY_REACH, 2000, Random(7));
  std::printf("%s: open share %.4f, counted %.4f; sky view factor %.4f, counted %.4f; bins %.4f\n",
              name, sky.open_share, counted.open_share, sky.sky_view_factor,
              counted.sky_view_factor, differenceOfBins(sky, counted));
  EXPECT_NEAR(sky.open_share, counted.open_share, 0.02) << name;
  EXPECT_NEAR(sky.sky_view_factor, counted.sky_view_factor, 0.02) << name;
  // One hit of a cell stands for all rays that enter it there, and a bin has 32 rays, so that bins
  // differ more than totals.
  EXPECT_LT(differenceOfBins(sky, counted), of_bins) << name;
}

TEST(SkyView, OfNothingIsOpen) {
  const SkyTransmittance sky = viewSky(Scene(), Vec3(3, 4, 0), SKY_REACH, one_thread);
  EXPECT_NEAR(sky.open_share, 1.0, 1e-12);
  EXPECT_NEAR(sky.sky_view_factor, 1.0, 1e-12);
  for (const double bin : sky.bins) EXPECT_EQ(bin, 1.0);
}

// N1: under an oak and in a clearing, at rest and in wind.
TEST(SkyView, IsWhatCountedRaysFind) {
  const Scene still = oaks(wind::Field(), 0.0), windy = oaks(breezeOf(Vec3(9, 2, 0)), 3.0);
  expectAsCounted(still, UNDER_AN_OAK, "under an oak", 0.025);
  expectAsCounted(still, IN_THE_CLEARING, "in a clearing", 0.025);
  expectAsCounted(windy, UNDER_AN_OAK, "under an oak in wind", 0.025);
  expectAsCounted(windy, IN_THE_CLEARING, "in a clearing in wind", 0.025);
  const auto at = [](const Scene& scene, const Vec3& place) {
    return viewSky(scene, place, SKY_REACH, one_thread);
  };
  EXPECT_LT(at(still, UNDER_AN_OAK).open_share, 0.5);
  EXPECT_GT(at(still, IN_THE_CLEARING).open_share, 0.5);
  EXPECT_GT(differenceOfBins(at(still, UNDER_AN_OAK), at(windy, UNDER_AN_OAK)), 0.004);
}

// The leaves of one straight branch are a cylinder of known radius and extinction.
TEST(SkyView, OfAWallOfLeavesIsBeerLambert) {
  forest::Layout layout;
  forest::Species species = forest::shippedSpecies("oak");
  species.limbs.resize(1);
  species.limbs[0].segments = 1;
  species.limbs[0].leaves = 40.0;
  species.leaf_size = 2.0;
  layout.species.push_back(species);
  layout.trees.push_back(oakAt(0.0, 0.0, 1));
  const auto replica = movingForest(layout, wind::Field());
  Scene scene;
  scene.trees.update(replica, Vec3::Zero(), SKY_REACH, START);
  const PosedTree& tree = *scene.trees.all().at(0);
  ASSERT_EQ(tree.parts(), 1u);
  const Rod& trunk = tree.branches()[0].rod;
  const double edge = tree.branches()[0].leaf_radius / 0.6;
  const double area = 0.4 * edge * edge * replica.grow(0).skeleton.branches[0].leaves;
  const double volume = PI * 0.36 * edge * edge * (trunk.length + 0.8 * edge);
  const double extinction = area / (2.0 * volume);
  const Vec3 middle = trunk.base + 0.5 * trunk.length * trunk.axis;
  const Vec3 across = cross(trunk.axis, Vec3(1, 0, 0)).normalized();
  const Vec3 along = cross(across, trunk.axis);
  for (const double offset : {0.5, 0.7, 0.95}) {
    const double beside = offset * tree.branches()[0].leaf_radius;
    const double half = std::sqrt(std::pow(tree.branches()[0].leaf_radius, 2) - beside * beside);
    const Vec3 place = middle + beside * across;
    EXPECT_NEAR(transmittance(scene, Ray(place - 5.0 * along, along), SKY_REACH),
                std::exp(-extinction * 2.0 * half), 1e-9);
    // Inside of the leaves, and with an end among them.
    EXPECT_NEAR(transmittance(scene, Ray(place, along), SKY_REACH), std::exp(-extinction * half),
                1e-9);
    EXPECT_NEAR(transmittance(scene, Ray(place - 5.0 * along, along), 5.0),
                std::exp(-extinction * half), 1e-9);
  }
  EXPECT_EQ(transmittance(scene, Ray(middle - 5.0 * along, along), SKY_REACH), 0.0);  // wood
  EXPECT_EQ(transmittance(scene, Ray(middle - 5.0 * along, along), 1.0), 1.0);
}

// Returns what every branch on the way of a ray lets through.
double transmittanceOfAll(const Trees& trees, const Ray& ray) {
  double depth = 0.0;
  for (const auto& tree : trees.all())
    for (std::size_t i = 0; i < tree->parts(); ++i) {
      Meeting meeting;
      if (meet(ray, tree->branches()[i].rod, SKY_REACH, meeting)) return 0.0;
      if (!(tree->branches()[i].leaf_radius > 0.0)) continue;
      const Stretch part = within(ray, tree->branches()[i].rod, tree->branches()[i].leaf_radius);
      depth += tree->branches()[i].extinction * std::max(0.0, part.to - part.from);
    }
  return std::exp(-depth);
}

TEST(SkyView, MeetsWhatTestingEveryBranchMeets) {
  const Scene scene = oaks(breezeOf(Vec3(9, 2, 0)), 3.0);
  int blocked = 0, open = 0;
  for (std::uint64_t i = 0; i < 1500; ++i) {
    const Ray ray(UNDER_AN_OAK, randomDirection(Random(3), i, 0.05, 1.5));
    const double right = transmittanceOfAll(scene.trees, ray);
    EXPECT_NEAR(transmittance(scene, ray, SKY_REACH), right, std::exp(-LightPath::DARK)) << i;
    blocked += right == 0.0;
    open += right == 1.0;
  }
  for (const int count : {blocked, open, 1500 - blocked - open}) EXPECT_GT(count, 20);
}

TEST(SkyView, IsTheSameForAnyNumberOfThreadsAndInstructionSet) {
  const Scene scene = oaks(breezeOf(Vec3(9, 2, 0)), 3.0);
  const SkyTransmittance alone = viewSky(scene, UNDER_AN_OAK, SKY_REACH, one_thread);
  for (const int count : {2, 3, 8}) {
    ThreadPool threads(count);
    const SkyTransmittance together = viewSky(scene, UNDER_AN_OAK, SKY_REACH, threads);
    EXPECT_EQ(together.bins, alone.bins);
    EXPECT_EQ(together.open_share, alone.open_share);
    EXPECT_EQ(together.sky_view_factor, alone.sky_view_factor);
  }
  for (const std::string& set : instructionSets()) {
    forceInstructionSet(set);
    EXPECT_EQ(viewSky(scene, UNDER_AN_OAK, SKY_REACH, one_thread).bins, alone.bins) << set;
  }
  forceInstructionSet("");
}

// Azimuths are counter-clockwise from x, and elevations begin at the horizon.
TEST(SkyView, OfATowerIsDarkInItsDirectionUpToItsHeight) {
  Scene scene;
  crowd::Skeleton tower{};
  for (crowd::Limb& limb : tower) limb = {Vec3(0, 10, 0), Vec3(0, 10, 5.0), 2.0};
  scene.people.set({{7, tower}});
  const SkyTransmittance sky = viewSky(scene, Vec3(0, 0, 0.01), SKY_REACH, one_thread);
  const auto bin = [&](int elevation, int azimuth) {
    return sky.bins[static_cast<std::size_t>(elevation * SKY_AZIMUTHS + azimuth)];
  };
  for (const int azimuth : {5, 6})  // 75 to 105 degrees; the tower takes 78.5 to 101.5
    for (int elevation = 0; elevation < SKY_ELEVATIONS; ++elevation) {
      if (elevation < 3) {
        EXPECT_NEAR(bin(elevation, azimuth), 1.0 - 11.54 / 15.0, 0.05);
      }
      if (elevation > 4) {
        EXPECT_EQ(bin(elevation, azimuth), 1.0);
      }
    }
  for (const int azimuth : {0, 4, 7, 17, 18}) EXPECT_EQ(bin(0, azimuth), 1.0);
  const SkyTransmittance near = viewSky(scene, Vec3(0, 0, 0.01), 5.0, one_thread);
  EXPECT_NEAR(near.open_share, 1.0, 1e-12);  // the tower is out of reach
}

TEST(SkyView, OnTheGroundIsThatJustAboveIt) {
  const Scene scene = oaks(wind::Field(), 0.0);
  const auto at = [&](double z) {
    return viewSky(scene, Vec3(1, 2, z), SKY_REACH, one_thread).open_share;
  };
  EXPECT_GT(at(0.01), 0.3);
  EXPECT_EQ(at(0.0), at(0.01));
  EXPECT_EQ(at(-3.0), at(0.01));
}

TEST(SkyView, PlantsOfACanopyBlock) {
  Scene scene;
  const Vec3 place(2.0, -2.4, 0.02);
  Grove(groveLayout()).show(scene.plants, one_thread);
  expectAsCounted(scene, place, "under a crown", 0.045);
  EXPECT_LT(viewSky(scene, place, SKY_REACH, one_thread).open_share, 0.9);
}

// A row of upright twigs with leaves, as those of a tree in leaf.
TEST(SkyView, LeafedCrownsOfTreesBlock) {
  canopy::Layout layout = groveLayout();
  layout.kinds[2].leaves = 2500;
  std::vector<canopy::Twig> twigs(5);
  std::vector<Pose> wood;
  for (std::size_t i = 0; i < twigs.size(); ++i) {
    twigs[i].pose.position = Vec3(0.4 * static_cast<double>(i), 0.0, 1.0);
    twigs[i].length = 1.5;
    twigs[i].share = 1.0;
    wood.push_back(twigs[i].pose);
  }
  const std::vector<canopy::CrownLeaf> leaves = growCrown(layout.kinds[2], 3, twigs);
  canopy::Canopy animator(layout);
  canopy::Replica replica(layout);
  animator.advance(canopy::tickStamp(0));
  replica.apply(animator.update(false));
  Scene scene;
  scene.crowns.update({{0, &leaves, &twigs, [&] { return wood; }}}, 1, replica.foliageOfPlane(),
                      Vec3::Zero(), one_thread);
  const Vec3 place(0.8, 0.1, 0.02);
  expectAsCounted(scene, place, "under leafed twigs", 0.045);
  EXPECT_LT(viewSky(scene, place, SKY_REACH, one_thread).open_share, 0.97);
}

// All rays begin in the same cell of the grass, so that counting needs several places.
TEST(SkyView, InALawnIsWhatCountedRaysFind) {
  Scene scene;
  const Lawn lawn(0.3, 400.0);
  lawn.show(scene.grass);
  double light = 0.0, counted = 0.0;
  constexpr int PLACES = 60;
  for (int i = 0; i < PLACES; ++i) {
    const Vec3 place(8.0 + 0.11 * (i % 10), 9.0 + 0.11 * (i / 10), 0.08);
    light += viewSky(scene, place, SKY_REACH, one_thread).open_share / PLACES;
    counted += countOpenRays(scene, place, SKY_REACH, 20, Random(7)).open_share / PLACES;
  }
  std::printf("in a lawn: open share %.4f, counted %.4f\n", light, counted);
  EXPECT_NEAR(light, counted, 0.02);
  EXPECT_LT(light, 0.9);
  EXPECT_GT(viewSky(scene, Vec3(10, 10, 0.4), SKY_REACH, one_thread).open_share, 0.999);
}

}  // namespace
}  // namespace vegetation_sim::scan
