// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/motion/motion_level.h"
#include "tree/lod/level_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/core/math/random.h"
#include "vegetation_sim/tree/motion/pose.h"

namespace vegetation_sim::forest {
namespace {

constexpr double TRANSITION = 2.0;

MotionLaw lawOf(TransitionShape shape) {
  MotionLaw out;
  out.transition = TRANSITION;
  out.transition_shape = shape;
  return out;
}

// S1-23: alpha runs from 0 to 1 and back, linearly, between t0 and t1.
TEST(Level, LinearTransitionRunsBothWays) {
  const MotionLaw law = lawOf(TransitionShape::LINEAR);
  LevelState state = LevelState::settled(0);
  setLevel(state, 1, seconds(10), TRANSITION);
  for (const double u : {0.0, 0.25, 0.5, 1.0})
    EXPECT_NEAR(weightsAt(state, seconds(10 + u * TRANSITION), law)[0], u, 1e-7);
  EXPECT_EQ(weightsAt(state, seconds(99), law)[0], 1.0);
  setLevel(state, 0, seconds(20), TRANSITION);
  for (const double u : {0.0, 0.25, 0.5, 1.0})
    EXPECT_NEAR(weightsAt(state, seconds(20 + u * TRANSITION), law)[0], 1.0 - u, 1e-7);
}

// S1-24: reversed at alpha = 0.37, the weight continues from there without a jump.
TEST(Level, TransitionReversesAtAnyTime) {
  for (const TransitionShape shape : {TransitionShape::LINEAR, TransitionShape::SMOOTH}) {
    const MotionLaw law = lawOf(shape);
    LevelState state = LevelState::settled(0);
    setLevel(state, 1, seconds(0), TRANSITION);
    const Nanoseconds turn = seconds(0.37 * TRANSITION);
    const double before = weightsAt(state, turn, law)[0];
    setLevel(state, 0, turn, TRANSITION);
    EXPECT_NEAR(weightsAt(state, turn, law)[0], before, 1e-6);  // blend is kept in float
    EXPECT_LT(weightsAt(state, turn + seconds(0.1), law)[0], before);
    EXPECT_EQ(weightsAt(state, turn + seconds(0.38 * TRANSITION), law)[0], 0.0);
  }
}

// E6: the smooth shape has zero rate at both ends; the rate of the linear one jumps.
TEST(Level, SmoothTransitionHasNoStepInSpeed) {
  LevelState state = LevelState::settled(0);
  setLevel(state, 1, seconds(0), TRANSITION);
  const auto rate = [&](TransitionShape shape, double t) {
    const MotionLaw law = lawOf(shape);
    return (weightsAt(state, seconds(t + 1e-3), law)[0] -
            weightsAt(state, seconds(t - 1e-3), law)[0]) /
           2e-3;
  };
  EXPECT_LT(std::fabs(rate(TransitionShape::SMOOTH, 0.002)), 0.01);
  EXPECT_GT(rate(TransitionShape::LINEAR, 0.002), 0.4);
}

// S1-45: a longer transition moves the tips more slowly.
TEST(Level, LongerTransitionLowersThePeakSpeed) {
  double peak[2] = {0.0, 0.0};
  for (const int slow : {0, 1}) {
    MotionLaw law = lawOf(TransitionShape::SMOOTH);
    law.transition = slow ? 4.0 : 1.0;
    Layout layout = gridLayout(2, 10.0);
    layout.motion = law;
    const Tree tree = growTree(layout, 0, terrain::HeightMap());
    wind::Instant steady;
    steady.mean = Vec3(6, 0, 0);
    LevelState state = LevelState::settled(0);
    setLevel(state, 4, seconds(0), law.transition);
    Vec3 before = tipOf(tree.skeleton.branches.back(), tree.skeleton.branches.back().rest);
    for (double t = 0.02; t < law.transition; t += 0.02) {
      const auto poses = poseBranches(tree, steady, weightsAt(state, seconds(t), law));
      const Vec3 tip = tipOf(tree.skeleton.branches.back(), poses.back());
      peak[slow] = std::max(peak[slow], length(tip - before) / 0.02);
      before = tip;
    }
  }
  EXPECT_NEAR(peak[0] / peak[1], 4.0, 0.4);
}

LevelTable table() {
  LevelTable out;
  out.omitted = {0.1, 0.05, 0.01, 0.0};
  return out;
}

// S1-22, S1-40: level 0 without wind; finer with more wind, nearer cameras, larger trees.
TEST(Level, ChoiceFollowsWindDistanceAndSize) {
  EXPECT_EQ(chooseLevel(table(), 0.0, 1e6, 1.0, 0), 0);
  EXPECT_EQ(chooseLevel(table(), 5.0, 0.0, 1.0, 0), 0);
  EXPECT_EQ(chooseLevel(table(), 5.0, 3.0, 1.0, 0), 1);
  EXPECT_EQ(chooseLevel(table(), 10.0, 3.0, 1.0, 0), 2);
  EXPECT_EQ(chooseLevel(table(), 5.0, 30.0, 1.0, 0), 3);
  EXPECT_EQ(chooseLevel(table(), 5.0, 30.0, 100.0, 0), 0);
}

// Compares with the angles themselves.
TEST(Level, EyeSeesWhatIsInItsCone) {
  const Random random(3);
  int seen = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    Viewpoint eye;
    const double half = random.uniform(8 * i, 0.1, 3.0),
                 radius = random.uniform(8 * i + 1, 0.1, 4.0);
    eye.cone_cosine = std::cos(half);
    const Vec3 centre(random.uniform(8 * i + 2, -9, 9), random.uniform(8 * i + 3, -9, 9),
                      random.uniform(8 * i + 4, -9, 9));
    const double distance = length(centre);
    const double angle = std::acos(centre.x() / distance);
    const bool expected =
        distance <= radius || angle - std::asin(std::min(1.0, radius / distance)) <= half;
    EXPECT_EQ(sees(eye, centre, radius), expected) << i;
    seen += expected;
  }
  EXPECT_GT(seen, 1000);
  EXPECT_LT(seen, 3800);
}

TEST(Level, BorderDoesNotFlicker) {
  int level = 0, flips = 0;
  for (int i = 0; i < 200; ++i) {
    const double speed =
        5.0 * (1.0 + 0.1 * (i % 2 ? 1 : -1));  // error 0.9 and 1.1 of the tolerance
    const int next = chooseLevel(table(), speed, 4.0, 1.0, level);
    flips += next != level;
    level = next;
  }
  EXPECT_EQ(flips, 2);  // up twice at the start, then never again
}

// The table bounds the omitted motion of trees that were not measured.
// Species and scale.
class LevelTableOf : public testing::TestWithParam<std::tuple<int, double>> {};
TEST_P(LevelTableOf, PredictsTheOmittedMotion) {
  const auto [kind, scale] = GetParam();
  Layout layout = gridLayout(4, 10.0);
  const Species& species = layout.species[static_cast<std::size_t>(kind)];
  LevelScales scales;
  scales.measure(species, layout.motion, scale);
  const LevelTable measured = scales.at(scale);
  wind::Instant steady;
  steady.mean = Vec3(1, 0, 0);
  for (auto id = static_cast<std::uint32_t>(kind); id < 16; id += 4) {
    layout.trees[id].scale = scale;
    const Tree tree = growTree(layout, id, terrain::HeightMap());
    const auto full = poseBranches(tree, steady, fullWeights());
    for (int level = 0; level < species.depths(); ++level) {
      Weights weights{};
      for (int d = 0; d < level; ++d) weights[static_cast<std::size_t>(d)] = 1.0;
      const auto cut = poseBranches(tree, steady, weights);
      double worst = 0.0;
      for (std::size_t i = 0; i < full.size(); ++i) {
        const Branch& b = tree.skeleton.branches[i];
        worst = std::max(worst, length(tipOf(b, full[i]) - tipOf(b, cut[i])));
      }
      const double predicted = measured.omitted[static_cast<std::size_t>(level)];
      // Six sample trees represent all; other trees may exceed them slightly, never by half.
      EXPECT_LT(worst, 1.5 * predicted) << id << " level " << level;
      EXPECT_GT(worst, 0.05 * predicted) << id << " level " << level;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Shipped, LevelTableOf,
                         testing::Combine(testing::Range(0, 4),
                                          testing::Values(0.28, 0.7, 1.0, 1.3, 2.2)));

}  // namespace
}  // namespace vegetation_sim::forest
