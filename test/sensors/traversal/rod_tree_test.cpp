// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/traversal/rod_tree.h"

#include <gtest/gtest.h>

#include "scenes/sensors/rods_scene.h"
#include "vegetation_sim/core/config/instruction_set.h"

namespace vegetation_sim::scan {
namespace {

const Vec3 PLACE(1234.5, -876.25, 40.0);

std::vector<double> noRoom(const std::vector<Rod>& rods) {
  return std::vector<double>(rods.size(), 0.0);
}

RodTree treeOf(const std::vector<Rod>& rods, const Vec3& origin = PLACE) {
  RodTree out;
  out.build(rods, noRoom(rods), origin);
  return out;
}

/// Compares the hits with those of a test of every rod, on every instruction set.
struct Compared {
  int rays{0}, hits{0}, different{0};
  std::size_t tested{0};
};

Compared compare(const RodTree& tree, const std::vector<Rod>& rods, const std::vector<Ray>& rays) {
  Compared out;
  std::vector<Hit> right;
  for (const Ray& ray : rays) right.push_back(castAtEach(rods, ray));
  for (const std::string& set : instructionSets()) {
    forceInstructionSet(set);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Hit hit = castInto(tree, rods, rays[i], out.tested);
      ++out.rays;
      out.hits += right[i].branch >= 0;
      out.different += !same(hit, right[i]);
    }
  }
  forceInstructionSet("");
  return out;
}

// N1
TEST(RodTree, GivesTheHitsOfATestOfEveryRodOnEveryInstructionSet) {
  ASSERT_GE(instructionSets().size(), 2u);
  for (const int count : {1, 2, 8, 9, 64, 65, 1000, 5000})
    for (const double size : {0.2, 5.0, 60.0}) {
      const std::vector<Rod> rods = scatteredRods(count, size, PLACE);
      const Compared all = compare(treeOf(rods), rods, raysAt(rods, 400, size, PLACE));
      EXPECT_EQ(all.different, 0) << count << " rods in " << size << " m";
      EXPECT_GT(all.hits, all.rays / 10) << count << " rods in " << size << " m";
    }
}

TEST(RodTree, LeadsAHundredThousandRodsToFewTests) {
  const std::vector<Rod> rods = scatteredRods(100000, 60.0, PLACE);
  const Compared all = compare(treeOf(rods), rods, raysAt(rods, 120, 60.0, PLACE));
  EXPECT_EQ(all.different, 0);
  EXPECT_GT(all.hits, all.rays / 10);
  EXPECT_LT(all.tested, static_cast<std::size_t>(all.rays) * 100);
}

// The origin may be far from the rods: boxes are larger then, and the hits are the same.
TEST(RodTree, GivesTheSameHitsForAnyOrigin) {
  const std::vector<Rod> rods = scatteredRods(500, 5.0, PLACE);
  const std::vector<Ray> rays = raysAt(rods, 400, 5.0, PLACE);
  for (const double away : {0.0, 10.0, 5000.0})
    EXPECT_EQ(compare(treeOf(rods, PLACE + Vec3(away, away, 0.0)), rods, rays).different, 0)
        << away;
}

// Poses in single precision give axes whose length differs from 1 by some 1e-7.
TEST(RodTree, AllowsForAxesThatAreNotQuiteUnitVectors) {
  std::vector<Rod> rods = scatteredRods(500, 5.0, PLACE);
  for (std::size_t i = 0; i < rods.size(); ++i) rods[i].axis *= 1.0 + 1e-6 * (i % 3 - 1.0);
  const Compared all = compare(treeOf(rods), rods, raysAt(rods, 2000, 5.0, PLACE));
  EXPECT_EQ(all.different, 0);
}

TEST(RodTree, OfRodsAtEqualDistancesTheFirstIsHit) {
  std::vector<Rod> rods = scatteredRods(100, 5.0, PLACE);
  for (int i = 0; i < 300; ++i) rods.push_back(rods[static_cast<std::size_t>(i) % 100]);
  std::vector<Rod> shuffled;  // so that equal rods come in several orders
  for (std::size_t i = 0; i < rods.size(); ++i) shuffled.push_back(rods[i * 37 % rods.size()]);
  const Compared all = compare(treeOf(shuffled), shuffled, raysAt(shuffled, 500, 5.0, PLACE));
  EXPECT_EQ(all.different, 0);
  EXPECT_GT(all.hits, all.rays / 4);
}

// N1
TEST(RodTree, ThatIsFittedToMovedRodsLeadsToWhatANewOneLeadsTo) {
  std::vector<Rod> rods = scatteredRods(1000, 5.0, PLACE);
  RodTree moved = treeOf(rods);
  const Random random(8);
  for (std::size_t i = 0; i < rods.size(); ++i) {
    rods[i].base += Vec3(random.uniform(2 * i, -1.0, 1.0), 0.0, 0.5);
    rods[i].axis = randomDirection(random, i + 5000, -1.5, 1.5);
  }
  moved.fit(rods, noRoom(rods), PLACE);
  const RodTree fresh = treeOf(rods);
  EXPECT_EQ(moved.bounds().low, fresh.bounds().low);
  EXPECT_EQ(moved.bounds().high, fresh.bounds().high);
  const std::vector<Ray> rays = raysAt(rods, 500, 5.0, PLACE);
  EXPECT_EQ(compare(moved, rods, rays).different, 0);
  EXPECT_EQ(compare(fresh, rods, rays).different, 0);
}

TEST(RodTree, OfNothingLeadsNowhere) {
  const RodTree tree = treeOf({});
  std::size_t tested = 0;
  castInto(tree, {}, Ray(Vec3::Zero(), Vec3::UnitX()), tested);
  EXPECT_EQ(tested, 0u);
  EXPECT_TRUE(tree.bounds().isEmpty());
}

TEST(RodTree, IsNotMetByRaysThatAreNotFiniteOrHaveNoReach) {
  const std::vector<Rod> rods = scatteredRods(100, 5.0, PLACE);
  const RodTree tree = treeOf(rods);
  constexpr double NONE = std::numeric_limits<double>::quiet_NaN(), ENDLESS = Box::ENDLESS;
  std::size_t tested = 0;
  for (const std::string& set : instructionSets()) {
    forceInstructionSet(set);
    for (const Ray& ray :
         {Ray(Vec3(NONE, 0, 0), Vec3::UnitX()), Ray(PLACE, Vec3(0, NONE, 1)),
          Ray(Vec3(0, ENDLESS, 0), Vec3::UnitX()), Ray(PLACE, Vec3(ENDLESS, 0, 0))})
      EXPECT_EQ(castInto(tree, rods, ray, tested).branch, -1);
    for (const double reach : {NONE, 0.0, -1.0, -ENDLESS})
      for (const Ray& ray : raysAt(rods, 50, 5.0, PLACE))
        EXPECT_EQ(castInto(tree, rods, ray, tested, reach).branch, -1);
  }
  forceInstructionSet("");
}

}  // namespace
}  // namespace vegetation_sim::scan
