// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/motion/batch_poser.h"

#include <gtest/gtest.h>

#include <cstring>

#include "scenes/forest/forest_fixture.h"

namespace vegetation_sim::forest {
namespace {

// Tolerance of the batched path: 1e-5 of the tree's height. Measured 7e-7; float has 6e-8 per step
// over some ten joints.
constexpr double BAR = 1e-5;

wind::Field everyKind() {
  std::vector<wind::Primitive> out{makeDisk(1, Vec3(4, 4, 0), 30.0, Vec3(3, 1, 0)),
                                   makeBreeze(2, Vec3(4, -1, 0))};
  const wind::Kind kinds[] = {wind::Kind::GUST, wind::Kind::TORNADO, wind::Kind::BLAST};
  for (std::uint32_t i = 0; i < 3; ++i) {
    wind::Primitive p = makeDisk(i + 3, Vec3(5.0 * i, 6, 3), 25.0, Vec3(4, 1, 0));
    p.kind = kinds[i];
    out.push_back(p);
  }
  wind::Primitive wake = makeDisk(7, Vec3::Zero(), 3.0, Vec3(1, 0, 0));
  wake.kind = wind::Kind::WAKE;
  wake.trajectory = {{seconds(1.7e9), Vec3(6, 6, 4)}, {seconds(1.7e9 + 9.0), Vec3(60, 50, 4)}};
  out.push_back(wake);
  wind::Primitive paper = makeDisk(6, Vec3(-3, 2, 0), 20.0, Vec3(1, 1, 0.2));
  paper.envelope = wind::Envelope::PAPER;
  out.push_back(paper);
  return wind::Field(out, 5);
}

struct Model {
  JointModel joint;
  Drag drag;
};

class BatchPoserOf : public testing::TestWithParam<Model> {
 protected:
  Layout layout() const {
    Layout out = gridLayout(3, 8.0);
    out.motion.joint_model = GetParam().joint;
    out.motion.drag = GetParam().drag;
    return out;
  }
};

TEST_P(BatchPoserOf, AgreesWithThePlainVersion) {
  const Layout forest = layout();
  const wind::Field field = everyKind();
  for (std::uint32_t id = 0; id < forest.treeCount(); ++id) {
    const Tree tree = growTree(forest, id, terrain::HeightMap());
    const BatchPoser poser(tree);
    const auto wind = field.at(seconds(1.7e9 + 0.37 * id)).relativeTo(tree.foot);
    Weights weights{1.0, 0.9, 0.5, 0.2, 0.0, 0.0};
    BatchPoses fast;
    poser.pose(wind, weights, MAX_DEPTHS, fast);
    const auto plain = poseBranches(tree, wind, weights);
    ASSERT_EQ(fast.count, static_cast<int>(plain.size()));
    for (int i = 0; i < fast.count; ++i) {
      const Branch& b = tree.skeleton.branches[static_cast<std::size_t>(i)];
      const Vec3 error = tipOf(b, fast.at(i)) - tipOf(b, plain[static_cast<std::size_t>(i)]);
      ASSERT_LT(length(error), BAR * tree.skeleton.height) << id << " " << i;
    }
  }
}

bool sameBits(const std::vector<float>& a, const std::vector<float>& b, int count) {
  return std::memcmp(a.data(), b.data(), sizeof(float) * static_cast<std::size_t>(count)) == 0;
}

TEST_P(BatchPoserOf, GivesTheSameBitsOnEveryInstructionSet) {
  const Layout forest = layout();
  const wind::Field field = everyKind();
  const std::vector<std::string> sets = instructionSets();
  ASSERT_GE(sets.size(), 2u);
  for (std::uint32_t id = 0; id < forest.treeCount(); ++id) {
    const Tree tree = growTree(forest, id, terrain::HeightMap());
    const BatchPoser poser(tree);
    const auto wind = field.at(seconds(1.7e9 + 0.37 * id)).relativeTo(tree.foot);
    BatchPoses first;
    poser.pose(wind, fullWeights(), MAX_DEPTHS, first);
    for (const std::string& set : sets) {
      forceInstructionSet(set);
      ASSERT_EQ(chosenInstructionSet(), set);
      BatchPoses other;
      poser.pose(wind, fullWeights(), MAX_DEPTHS, other);
      forceInstructionSet("");
      EXPECT_TRUE(
          sameBits(first.x, other.x, first.count) && sameBits(first.y, other.y, first.count) &&
          sameBits(first.z, other.z, first.count) && sameBits(first.qw, other.qw, first.count) &&
          sameBits(first.qx, other.qx, first.count) && sameBits(first.qy, other.qy, first.count) &&
          sameBits(first.qz, other.qz, first.count))
          << set << " tree " << id;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Models, BatchPoserOf,
                         testing::Values(Model{JointModel::SWING, Drag::LINEAR},
                                         Model{JointModel::PAPER, Drag::LINEAR},
                                         Model{JointModel::SWING, Drag::QUADRATIC}));

TEST(BatchPoser, BoundsTheAnglesInAStorm) {
  const Layout forest = gridLayout(2, 8.0);
  const Tree tree = growTree(forest, 2, terrain::HeightMap());
  const wind::Field storm({makeBreeze(1, Vec3(99, 0, 0))});
  const auto wind = storm.at(seconds(3.0)).relativeTo(tree.foot);
  BatchPoses fast;
  BatchPoser(tree).pose(wind, fullWeights(), MAX_DEPTHS, fast);
  const auto plain = poseBranches(tree, wind, fullWeights());
  for (int i = 0; i < fast.count; ++i)
    ASSERT_LT(length(fast.at(i).position - plain[static_cast<std::size_t>(i)].position),
              BAR * tree.skeleton.height);
}

// S1-21, S1-39: depths beyond the level are carried at rest, or not posed at all.
TEST(BatchPoser, PosesOnlyTheDepthsAsked) {
  const Tree tree = growTree(gridLayout(2, 8.0), 0, terrain::HeightMap());
  const auto wind =
      wind::Field({makeBreeze(1, Vec3(6, 2, 0))}).at(seconds(1.7e9)).relativeTo(tree.foot);
  const Weights weights{1.0, 1.0};  // of the two lowest depths only
  BatchPoses all, some;
  BatchPoser(tree).pose(wind, weights, MAX_DEPTHS, all);
  BatchPoser(tree).pose(wind, weights, 2, some);
  ASSERT_EQ(some.count, tree.skeleton.depth_end[1]);
  ASSERT_EQ(all.count, static_cast<int>(tree.skeleton.branches.size()));
  EXPECT_TRUE(sameBits(some.x, all.x, some.count) && sameBits(some.qw, all.qw, some.count));
  double bent = 0.0, carried = 0.0;
  for (int i = 1; i < all.count; ++i) {
    const Branch& branch = tree.skeleton.branches[static_cast<std::size_t>(i)];
    if (branch.parent < 0) continue;
    const Pose parent = all.at(branch.parent), own = all.at(i);
    const Quat turn = conjugate(parent.orientation) * own.orientation;
    const Quat rest = restRotation(branch.theta, branch.phi);
    const double away = length(axisZ(turn) - axisZ(rest));
    (branch.depth < 2 ? bent : carried) = std::max(branch.depth < 2 ? bent : carried, away);
  }
  EXPECT_GT(bent, 0.003);
  EXPECT_LT(carried, 1e-5);  // floats; on their own these joints bend by more than the lower ones
  BatchPoses free;
  BatchPoser(tree).pose(wind, fullWeights(), MAX_DEPTHS, free);
  double moved = 0.0;
  for (int i = some.count; i < all.count; ++i)
    moved = std::max(moved, length(free.at(i).position - all.at(i).position));
  EXPECT_GT(moved, 0.01);
}

// Every available instruction set can be forced and is then used; an unknown one is rejected.
TEST(BatchPoser, UsesTheInstructionSetThatIsForced) {
  for (const std::string& set : instructionSets()) {
    forceInstructionSet(set);
    EXPECT_EQ(chosenInstructionSet(), set);
  }
  forceInstructionSet("");
  EXPECT_EQ(chosenInstructionSet(), instructionSets().front());
  EXPECT_THROW(forceInstructionSet("AVX99"), InvalidInput);
  EXPECT_EQ(chosenInstructionSet(), instructionSets().front());
}

}  // namespace
}  // namespace vegetation_sim::forest
