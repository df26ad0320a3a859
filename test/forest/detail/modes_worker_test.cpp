// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/detail/modes_worker.h"

#include <gtest/gtest.h>

#include "scenes/forest/modal_forest_scene.h"

namespace vegetation_sim::forest {
namespace {

void expectEqual(const ModalTreeState& a, const ModalTreeState& b) {
  ASSERT_EQ(a.modes().size(), b.modes().size());
  EXPECT_EQ(a.modes().modes().frequency, b.modes().modes().frequency);
  EXPECT_EQ(a.modes().modes().damping, b.modes().modes().damping);
  EXPECT_EQ(a.modes().modes().shape, b.modes().modes().shape);
}

BrokenTrees withoutABranch(std::uint32_t tree) {
  BrokenBranch broken;
  broken.branch = 20;
  return {{tree, {broken}}};
}

// N6: another thread computes the bits that this one would. It does not need the layout any more.
TEST(ModesWorker, GivesTheModesThatAreComputedAtOnce) {
  const terrain::HeightMap flat;
  const wind::Field wind = breeze();
  ModesWorker worker;
  const BrokenTrees broken = withoutABranch(1);
  const Layout layout = gridLayout(2, 12.0);
  {
    const Layout copy = layout;
    for (const std::uint32_t tree : {0u, 1u})
      worker.begin({copy, flat, wind, &broken}, {tree, tree == 1});
  }
  const ModalContext at{layout, flat, wind, &broken};
  for (const std::uint32_t tree : {0u, 1u}) {
    const ModalTreeState* found = worker.find(at, {tree, tree == 1});
    ASSERT_NE(found, nullptr);
    ModalForest reference;
    reference.addTree(at, tree, tree == 1, PHYSICS_START);
    expectEqual(*found, *reference.find(tree));
  }
  EXPECT_TRUE(worker.isIdle());
}

TEST(ModesWorker, ForgetsWhatIsNotNeededOrHasChanged) {
  const terrain::HeightMap flat;
  const wind::Field wind = breeze();
  const Layout layout = gridLayout(2, 12.0);
  const ModalContext whole{layout, flat, wind};
  ModesWorker worker;
  EXPECT_EQ(worker.find(whole, {0, false}), nullptr);
  for (const std::uint32_t tree : {0u, 1u, 2u}) worker.begin(whole, {tree, false});
  EXPECT_EQ(worker.find(whole, {0, true}), nullptr);
  worker.retain({{0, false}, {1, false}});
  EXPECT_EQ(worker.find(whole, {2, false}), nullptr);
  EXPECT_NE(worker.find(whole, {0, false}), nullptr);
  const BrokenTrees broken = withoutABranch(0);
  const ModalContext after{layout, flat, wind, &broken};
  EXPECT_EQ(worker.find(after, {0, false}), nullptr) << "has lost a branch";
  EXPECT_NE(worker.find(after, {1, false}), nullptr);
  worker.begin(after, {0, false});
  EXPECT_NE(worker.find(after, {0, false}), nullptr);
  worker.clear();
  EXPECT_EQ(worker.find(after, {0, false}), nullptr);
}

}  // namespace
}  // namespace vegetation_sim::forest
