// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/state/promoted_branches.h"

#include <gtest/gtest.h>

#include "scenes/forest/forest_fixture.h"

namespace vegetation_sim::forest {
namespace {

// An oak in a wind with two physical branches.
struct HeldOak {
  Tree tree = growTree(gridLayout(1, 5.0), 0, *flatTerrain());
  wind::Field field{{makeDisk(1, Vec3(0, 0, 0), 50.0, Vec3(6, 2, 0))}};
  wind::Instant wind = field.at(seconds(3));
  PromotedTree promoted{seconds(3), 1.5, {{1, {0.1, -0.2}, {0.5, 0.0}}, {7, {0.3, 0.1}, {}}}};
  Weights weights = fullWeights();

  std::vector<Pose> all() const {
    return poseBranches(tree, wind, weights, nullptr, promoted, seconds(3));
  }
  ReachedPoses reached(const std::function<bool(int, const Pose&)>& enters) const {
    return poseReached(tree, wind, weights, nullptr, promoted, seconds(3), enters);
  }
};

TEST(PoseReached, HasTheSameBitsAsAllPosesAndLeavesOutWhatIsNotEntered) {
  const HeldOak oak;
  const std::vector<Pose> all = oak.all();
  std::size_t calls = 0;
  const ReachedPoses some = oak.reached([&](int branch, const Pose& pose) {
    ++calls;
    EXPECT_EQ(pose.position, all[std::size_t(branch)].position);
    return branch % 5 != 4;
  });
  std::size_t left_out = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int parent = oak.tree.skeleton.branches[i].parent;
    const bool posed = parent < 0 || some.entered[std::size_t(parent)];
    left_out += !posed;
    EXPECT_EQ(bool(some.entered[i]), posed && i % 5 != 4) << i;
    if (!posed) continue;
    EXPECT_EQ(some.poses[i].position, all[i].position) << i;
    EXPECT_EQ(axisZ(some.poses[i].orientation), axisZ(all[i].orientation)) << i;
  }
  EXPECT_GT(left_out, all.size() / 5);
  EXPECT_EQ(calls, all.size() - left_out);
}

TEST(PoseReached, EntersEverythingIfAsked) {
  const HeldOak oak;
  const std::vector<Pose> all = oak.all();
  const ReachedPoses same = oak.reached([](int, const Pose&) { return true; });
  for (std::size_t i = 0; i < all.size(); ++i)
    ASSERT_EQ(same.poses[i].position, all[i].position) << i;
}

}  // namespace
}  // namespace vegetation_sim::forest
