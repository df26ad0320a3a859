// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/physical/influence.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/forest/forest_fixture.h"

namespace vegetation_sim::forest {
namespace {

constexpr double TOLERANCE = 0.005;  // [m], the default
constexpr std::size_t NO_CAP = 1000000;

struct Case {
  Skeleton skeleton = grow(gridLayout(1, 1.0).trees[0], shippedSpecies("oak"));
  Wood wood = woodOf(skeleton, shippedSpecies("oak"), Material::BEAM);
  std::vector<char> none = std::vector<char>(skeleton.branches.size(), 0);

  int twig() const { return static_cast<int>(skeleton.branches.size()) - 1; }
  std::vector<int> select(int branch, double newton, std::size_t cap = NO_CAP) const {
    std::vector<double> score = predictDeflection(
        skeleton, wood, {{branch, skeleton.branches[branch].length, Vec3(newton, 0, 0)}});
    score[branch] = LOADED;
    return selectBranches(skeleton, score, TOLERANCE, TOLERANCE, none, cap).branches;
  }
};

bool has(const std::vector<int>& list, int branch) {
  return std::binary_search(list.begin(), list.end(), branch);
}

// Expects that a branch whose parent is not in the list has no ancestor in it.
bool hasNoGaps(const Skeleton& skeleton, const std::vector<int>& list) {
  for (const int i : list) {
    int parent = skeleton.branches[i].parent;
    if (parent >= 0 && has(list, parent)) continue;
    for (; parent >= 0; parent = skeleton.branches[parent].parent)
      if (has(list, parent)) return false;
  }
  return true;
}

// S1-W7, S1-W8, N12: a bird on a twig leaves the trunk procedural, a strong pull there does not.
TEST(Influence, TwigLoadLeavesTheTrunkAloneHeavyLoadTakesIt) {
  const Case c;
  const std::vector<int> light = c.select(c.twig(), 0.2), heavy = c.select(c.twig(), 3000.0);
  RecordProperty("light", static_cast<int>(light.size()));
  RecordProperty("heavy", static_cast<int>(heavy.size()));
  EXPECT_TRUE(has(light, c.twig()));
  EXPECT_FALSE(has(light, 0));
  EXPECT_LT(light.size(), 10u);
  EXPECT_TRUE(has(heavy, 0));
  EXPECT_GT(heavy.size(), light.size());
  EXPECT_TRUE(hasNoGaps(c.skeleton, light));
  EXPECT_TRUE(hasNoGaps(c.skeleton, heavy));
}

// N12: twice the load gives twice the deflection, for ancestors and others.
TEST(Influence, PredictionIsLinear) {
  const Case c;
  const auto once = predictDeflection(c.skeleton, c.wood, {{c.twig(), 0.1, Vec3(1, 2, 0)}});
  const auto twice = predictDeflection(c.skeleton, c.wood, {{c.twig(), 0.1, Vec3(2, 4, 0)}});
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_NEAR(twice[i], 2 * once[i], 1e-9 * twice[i]);
}

// S1-W8: the static part is lever x force / k, for a pull across the tip of the trunk's last piece.
TEST(Influence, PathDeflectionIsLeverTimesForceOverStiffness) {
  Skeleton pole;
  Branch branch;
  branch.length = 2.0;
  branch.base_radius = branch.tip_radius = 0.05;
  pole.branches = {branch};
  const Wood wood = woodOf(pole, shippedSpecies("oak"), Material::BEAM);
  const auto out = predictDeflection(pole, wood, {{0, 2.0, Vec3(10, 0, 0)}});
  EXPECT_NEAR(out[0], 2.0 * 20.0 / wood.stiffness[0], 1e-12);
  EXPECT_NEAR(compliance(pole, wood, 0, 2.0, Vec3(1, 0, 0)), 4.0 / wood.stiffness[0], 1e-15);
  EXPECT_NEAR(compliance(pole, wood, 0, 2.0, Vec3(0, 0, 1)), 0.0, 1e-15);
}

// S1-43: the paper's rule selects all joints up to the depth of the grabbed one.
TEST(Influence, DepthRuleTakesEveryJointUpToTheGrabbedDepth) {
  const Case c;
  int limb = 0;
  while (c.skeleton.branches[limb].depth < 2) ++limb;
  std::vector<double> score = scoreByDepth(c.skeleton, {limb});
  const auto list = selectBranches(c.skeleton, score, 0.0, 0.0, c.none, NO_CAP).branches;
  for (int i = 0; i < static_cast<int>(c.skeleton.branches.size()); ++i)
    EXPECT_EQ(has(list, i), c.skeleton.branches[i].depth <= 2) << i;
}

// N12: never more than the cap, the most deflected first, the loaded one always, without gaps.
TEST(Influence, CapKeepsTheMostDeflected) {
  const Case c;
  const std::vector<int> all = c.select(c.twig(), 3000.0);
  for (const std::size_t cap : {1u, 2u, 3u, 10u, 40u}) {
    ASSERT_GT(all.size(), cap);
    const std::vector<int> some = c.select(c.twig(), 3000.0, cap);
    EXPECT_LE(some.size(), cap);
    EXPECT_TRUE(has(some, c.twig())) << cap;
    EXPECT_TRUE(hasNoGaps(c.skeleton, some)) << cap;
    for (const int i : some) EXPECT_TRUE(has(all, i));
  }
}

// N12: physical branches keep their place until they are procedural again; new ones get the
// remaining room, the loaded one first.
TEST(Influence, CapCountsWhatIsPhysicalButNotWanted) {
  const Case c;
  const int loaded = c.twig(), other = loaded - 1;
  std::vector<double> score(c.none.size(), 0.0);
  score[other] = 1.0;
  score[loaded] = LOADED;
  std::vector<char> promoted = c.none;
  promoted[5] = promoted[6] = promoted[7] = 1;
  const auto pick = [&](std::size_t cap) {
    return selectBranches(c.skeleton, score, TOLERANCE, TOLERANCE, promoted, cap);
  };
  EXPECT_EQ(pick(5).branches, (std::vector<int>{other, loaded}));
  EXPECT_EQ(pick(5).refused, 0u);
  EXPECT_EQ(pick(4).branches, std::vector<int>{loaded});
  EXPECT_EQ(pick(4).refused, 1u);
  EXPECT_TRUE(pick(3).branches.empty());
  EXPECT_EQ(pick(3).refused, 2u);
  EXPECT_TRUE(pick(0).branches.empty());
}

// N12: branches stay physical until their deflection is well below the threshold.
TEST(Influence, HysteresisKeepsWhatIsPhysical) {
  const Case c;
  std::vector<double> score(c.none.size(), 0.0);
  score[5] = 0.8 * TOLERANCE;
  EXPECT_TRUE(selectBranches(c.skeleton, score, TOLERANCE, 0.5 * TOLERANCE, c.none, NO_CAP)
                  .branches.empty());
  std::vector<char> promoted = c.none;
  promoted[5] = 1;
  EXPECT_EQ(
      selectBranches(c.skeleton, score, TOLERANCE, 0.5 * TOLERANCE, promoted, NO_CAP).branches,
      std::vector<int>{5});
}

}  // namespace
}  // namespace vegetation_sim::forest
