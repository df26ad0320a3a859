// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/plants/plant_field.h"

#include <gtest/gtest.h>

#include "reference/sensors/cast_plain.h"
#include "scenes/sensors/grove_scene.h"
#include "scenes/sensors/lidar_scene.h"
#include "vegetation_sim/core/config/instruction_set.h"

namespace vegetation_sim::scan {
namespace {

ThreadPool alone;

/// Ray number i from around the plants into them.
Ray rayInto(std::uint64_t i) {
  const Vec3 way = randomDirection(Random(3), i, -0.5, 0.2);
  const Vec3 target(Random(4).uniform(2 * i, -1.0, 3.0), Random(4).uniform(2 * i + 1, -3.0, 1.0),
                    0.8);
  return {target - 6.0 * way, way};
}

Hit castInto(const Plants& plants, const Ray& ray) {
  Hit out;
  out.distance = 40.0;
  plants.meet(ray, FloatRay(ray), out);
  return out;
}

TEST(PlantField, FindsWhatTestingEveryLeafFinds) {
  Grove grove(groveLayout());
  Plants plants;
  grove.show(plants, alone);
  EXPECT_EQ(plants.all().size(), 4u);
  EXPECT_EQ(plants.leaves(), 200u + 200u + 360u + 400u);
  std::array<int, LABELS> labels{};
  for (int round = 0; round < 2; ++round) {
    for (std::uint64_t i = 0; i < 1500; ++i) {
      const Ray ray = rayInto(i);
      Hit plain;
      plain.distance = 40.0;
      meetEachPlant(plants, ray, plain);
      ++labels[static_cast<std::size_t>(plain.label)];
      for (const std::string& set : instructionSets()) {
        forceInstructionSet(set);
        EXPECT_TRUE(same(castInto(plants, ray), plain)) << i << " " << set;
      }
      forceInstructionSet("");
    }
    grove.advance(60, 75);
    grove.show(plants, alone);
  }
  EXPECT_GT(labels[static_cast<std::size_t>(Label::FOLIAGE)], 300);
  EXPECT_GT(labels[static_cast<std::size_t>(Label::STEM)], 10);
}

TEST(PlantField, OnlyCutPlantsAreGrownAgain) {
  Grove grove(groveLayout(), false);
  Plants plants;
  grove.show(plants, alone);
  const auto before = plants.all();
  grove.cut({1}, 0.4);
  grove.advance(60, 61);
  grove.show(plants, alone);
  ASSERT_EQ(plants.all().size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(plants.all()[i] == before[i], before[i]->id() != 1) << i;
    EXPECT_EQ(plants.all()[i]->cutHeight(), before[i]->id() == 1 ? 0.4 : canopy::UNCUT);
  }
}

// The leaves at a tick are those that the animator's foliage moves, corner by corner.
TEST(PlantField, LeavesMoveWithTheWind) {
  Grove windy(groveLayout()), calm(groveLayout(), false);
  Plants moved, still;
  windy.show(moved, alone);
  calm.show(still, alone);
  double most = 0.0;
  for (std::size_t plant = 0; plant < moved.all().size(); ++plant) {
    const auto &there = moved.all()[plant]->strips(), &here = still.all()[plant]->strips();
    ASSERT_EQ(there.size(), here.size());
    for (std::size_t i = 0; i < here.size(); ++i)
      most = std::max(most, length(there[i].tip - here[i].tip));
  }
  EXPECT_GT(most, 0.01);
  EXPECT_LT(most, 1.2);
}

TEST(PlantField, LeavesDependOnNoViewer) {
  canopy::CutView eye{Vec3(-3.0, 6.0, 1.0), {0.8, 0.0, 0.0, -0.6}};
  Grove watched(groveLayout(), true, eye), unwatched(groveLayout());
  Plants one, other;
  watched.show(one, alone);
  unwatched.show(other, alone);
  for (std::size_t plant = 0; plant < one.all().size(); ++plant)
    for (std::size_t i = 0; i < one.all()[plant]->strips().size(); ++i)
      ASSERT_EQ(one.all()[plant]->strips()[i].tip, other.all()[plant]->strips()[i].tip);
}

TEST(PlantField, IsTheSameForAnyNumberOfThreads) {
  Grove grove(groveLayout());
  Plants one, three;
  ThreadPool threads(3);
  grove.show(one, alone);
  grove.show(three, threads);
  for (std::uint64_t i = 0; i < 500; ++i)
    EXPECT_TRUE(same(castInto(one, rayInto(i)), castInto(three, rayInto(i))));
}

TEST(PlantField, FarPlantsAreLeftOutAndThoseBeyondTheBudgetAreCounted) {
  Grove grove(groveLayout());
  Plants few(450);
  grove.show(few, alone, Vec3(2.0, 0.3, 0.0));
  EXPECT_EQ(few.all().size(), 2u);
  EXPECT_EQ(few.leftOut(), 2u);
  EXPECT_EQ(few.all()[0]->id(), 1u);  // the nearest
  Plants none;
  grove.show(none, alone, Vec3(80.0, 0.0, 0.0), 20.0);
  EXPECT_TRUE(none.all().empty());
  EXPECT_EQ(none.leftOut(), 0u);
  const Hit hit = castInto(none, rayInto(1));
  EXPECT_EQ(hit.label, Label::NONE);
}

TEST(PlantField, PlantsOfAnotherLayoutAreGrownAgain) {
  Grove grove(groveLayout());
  Plants plants;
  grove.show(plants, alone);
  const auto first = plants.all()[0];
  grove.show(plants, alone);
  EXPECT_EQ(plants.all()[0], first);
  canopy::Layout other = groveLayout();
  other.plants[0].scale = 2.0;
  canopy::Replica replica(other);
  plants.update(replica.layout(), replica.layoutHash(), replica.foliageOfPlane(), Vec3::Zero(),
                60.0, alone);
  EXPECT_NE(plants.all()[0], first);
}

}  // namespace
}  // namespace vegetation_sim::scan
