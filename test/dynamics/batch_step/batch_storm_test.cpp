// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The batched steppers in storms: equal bits everywhere, bounded, and at rest in the end.
#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/dynamics/framed_chain.h"
#include "vegetation_sim/core/config/instruction_set.h"

namespace vegetation_sim::physics {
namespace {

using Trees = std::vector<std::vector<Link>>;

// Trees of odd sizes and shapes in a storm, held and shaken: every path of the kernels.
template <class Batch>
std::vector<ChainState> storm(const Trees& trees) {
  Batch batch(trees);
  std::vector<Surroundings> around;
  for (const std::vector<Link>& links : trees) {
    around.push_back(gustAndPull(links, 100.0, 50.0));
    around.back().bases = [](double t, std::vector<BaseMotion>& bases) {
      bases.assign(1, BaseMotion());
      bases[0].spin = Vec3(std::sin(t), 0.0, 0.3);
      bases[0].acceleration = Vec3(0.0, 5.0 * std::cos(t), 0.0);
    };
    const auto air = around.back().loads, held = gripper(links).loads;
    around.back().loads = [air, held](const Kinematics& k, double t, Loads& loads) {
      air(k, t, loads);
      if (t > 0.2) held(k, t, loads);
    };
  }
  for (std::size_t t = 0; t < trees.size(); ++t)
    batch.setState(static_cast<int>(t), randomState(trees[t].size(), 0.8, 3.0, t));
  for (int i = 0; i < 120; ++i) batch.step(around, i * STEP, STEP);
  std::vector<ChainState> out;
  for (int t = 0; t < batch.treeCount(); ++t) out.push_back(batch.state(t));
  return out;
}

template <class Batch>
void expectSameBits(const Trees& trees) {
  const std::vector<std::string> sets = instructionSets();
  ASSERT_GE(sets.size(), 2u);
  const std::vector<ChainState> best = storm<Batch>(trees);
  double largest = 0.0;
  for (const ChainState& state : best)
    for (const Vec2& q : state.q) largest = std::max({largest, std::fabs(q.x()), std::fabs(q.y())});
  EXPECT_GT(largest, 1.0);  // otherwise the rotation series for large bends would not be tested
  EXPECT_LT(largest, 1e3);
  for (const std::string& set : sets) {
    forceInstructionSet(set);
    const std::vector<ChainState> other = storm<Batch>(trees);
    forceInstructionSet("");
    for (std::size_t t = 0; t < best.size(); ++t)
      EXPECT_TRUE(sameBits(best[t], other[t])) << set << " tree " << t;
  }
}

TEST(BatchChain, GivesTheSameBitsOnEveryInstructionSet) {
  Trees trees;
  for (const int n : {1, 7, 33, 1001, 100, 2}) trees.push_back(fractalTree(n, 7));
  trees[2][5].inertia.xy = 1e-3 * trees[2][5].inertia.xx;  // not a bar
  expectSameBits<BatchChain>(trees);
  expectSameBits<FramedChain>(trees);
}

// The other trees of the batch, and the lane of a link, do not matter.
template <class Batch>
void expectNoFeeling() {
  Trees trees;
  for (const int n : {7, 100, 1001, 2500, 33}) trees.push_back(fractalTree(n, 7));
  trees[1][5].inertia.xy = 1e-3 * trees[1][5].inertia.xx;  // not a bar
  const std::vector<ChainState> together = storm<Batch>(trees);
  for (std::size_t t = 0; t < trees.size(); ++t) {
    Trees others(t, fractalTree(3, 1));  // the same index, and so the same start
    others.push_back(trees[t]);
    EXPECT_TRUE(sameBits(storm<Batch>(others)[t], together[t])) << t;
  }
}

TEST(BatchChain, TreesDoNotAffectEachOther) {
  expectNoFeeling<BatchChain>();
  expectNoFeeling<FramedChain>();
}

// ---- stability ---------------------------------------------------------------------------------

template <class Batch>
class BatchedStorm : public testing::Test {};
using StormSteppers = testing::Types<BatchChain, FramedChain>;
TYPED_TEST_SUITE(BatchedStorm, StormSteppers);

// Largest |q| over a storm and its ring-down, and at the end.
struct Bends {
  double largest{0.0}, last{0.0};
};

template <class Batch>
Bends bendsIn(const std::vector<Link>& links, const Surroundings& around, double h,
              double seconds) {
  Batch batch(Trees{links});
  Bends out;
  const int steps = static_cast<int>(seconds / h);
  for (int i = 0; i < steps; ++i) {
    batch.step(std::vector<Surroundings>{around}, i * h, h);
    out.last = 0.0;
    for (const Vec2& q : batch.state(0).q) out.last = std::max(out.last, q.norm());
    out.largest = std::max(out.largest, out.last);
    if (!(out.last < 1e6)) break;
  }
  return out;
}

// Motion is bounded in float for every step from 0.1 to 50 ms with stiffness 1e6 apart in one tree
// and storms of 30x gust; the bound is that of the plain stepper's test, and all joints come back.
TYPED_TEST(BatchedStorm, StaysBoundedForEveryStepInAnyStorm) {
  std::vector<Link> links = crown(63, 0.1);
  links[0].stiffness = 0.0;
  const auto softer = [](const Link& a, const Link& b) { return a.stiffness < b.stiffness; };
  links[0].stiffness = 1e6 * std::min_element(links.begin() + 1, links.end(), softer)->stiffness;
  const Surroundings blow = gust(links, 30.0 * 20.0);
  for (const double h : {1e-4, 1e-3, STEP, 1.0 / 60.0, 0.03, 0.05}) {
    const Bends bends = bendsIn<TypeParam>(links, blow, h, h < 1e-3 ? 1.5 : 12.0);
    EXPECT_LT(bends.largest, 20.0) << h;
    EXPECT_LT(bends.last, h < 1e-3 ? 20.0 : 0.05) << h;
  }
  const std::vector<Link> tree = fractalTree(60, 9);
  const Surroundings storm = gustAndPull(tree, 30.0 * 18.0, 0.0);
  for (const double h : {1e-4, 1e-3, STEP, 1.0 / 60.0, 0.03, 0.05}) {
    const Bends bends = bendsIn<TypeParam>(tree, storm, h, 2.0);
    EXPECT_LT(bends.largest, 1.0) << h;
    EXPECT_LT(bends.last, 0.1) << h;
  }
}

// S1-W4: far beyond in float too: stiffness 1e8 apart, steps up to half a second. Joints reach
// their stops, stay finite, and come back.
TYPED_TEST(BatchedStorm, StopsHoldFarBeyond) {
  std::vector<Link> links = crown(63, 0.1);
  spreadStiffness(links, 1e8);
  const Surroundings blow = gust(links, 30.0 * 20.0);
  for (const double h : {1e-3, 1.0 / 60.0, 0.05, 0.5}) {
    const Bends bends = bendsIn<TypeParam>(links, blow, h, std::max(12.0, 200.0 * h));
    EXPECT_LE(bends.largest, LARGEST_BEND * (1.0 + 1e-6)) << h;
    EXPECT_GT(bends.largest, 1.0) << h;
  }
}

// A tree without loads comes to rest exactly: denormal numbers would slow every step.
TYPED_TEST(BatchedStorm, ComesToRestExactly) {
  const std::vector<Link> links = fractalTree(20, 9);
  TypeParam batch(Trees{links});
  batch.setState(0, randomState(links.size(), 0.01, 0.0, 1));
  for (int i = 0; i < 20000; ++i) batch.step(0.02);
  for (const Vec2& q : batch.state(0).q) ASSERT_EQ(q, Vec2::Zero());
}

}  // namespace
}  // namespace vegetation_sim::physics
