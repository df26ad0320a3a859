// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Trees that are swept in parts, because they outgrow the caches.
#include <gtest/gtest.h>

#include <algorithm>

#include "physics/chain_parts.h"
#include "physics/chain_scene.h"
#include "vegetation_sim/common/instruction_set.h"
#include "vegetation_sim/physics/batch_chain.h"

namespace vegetation_sim::physics {
namespace {

constexpr double STEP = 1.0 / 240.0;

std::vector<int> parentsOf(const std::vector<Link>& links) {
  std::vector<int> out;
  for (const Link& link : links) out.push_back(link.parent);
  return out;
}

struct Sorted {
  std::vector<ChainPart> parts;
  std::vector<JointRows> hung;
  std::vector<int> slots;
  Sorted(const std::vector<int>& parents, std::size_t most) {
    sortIntoParts(parents, most, 0, parts, hung, slots);
  }
  std::size_t partOf(int slot) const {
    std::size_t out = 0;
    while (slot >= parts[out].end) ++out;
    return out;
  }
};

TEST(ChainParts, SmallTreesAreOnePart) {
  const Sorted sorted(parentsOf(fractalTree(500, 3)), 500);
  EXPECT_EQ(sorted.parts.size(), 1u);
  EXPECT_TRUE(sorted.hung.empty());
}

// Every sub-tree hangs on the stem by its root, and no part is larger than it may be.
TEST(ChainParts, LargeTreesAreAStemAndWhatHangsOnIt) {
  const std::vector<int> parents = parentsOf(fractalTree(3000, 3));
  const Sorted sorted(parents, 400);
  ASSERT_GT(sorted.parts.size(), 7u);
  std::vector<int> slots = sorted.slots;
  std::sort(slots.begin(), slots.end());
  EXPECT_TRUE(std::adjacent_find(slots.begin(), slots.end()) == slots.end());
  std::vector<std::size_t> joints(sorted.parts.size(), 0);
  std::size_t cut = 0;
  for (std::size_t i = 0; i < parents.size(); ++i) {
    const std::size_t part = sorted.partOf(sorted.slots[i]);
    ++joints[part];
    if (parents[i] < 0) {
      EXPECT_EQ(part, 0u);
      continue;
    }
    const int below = sorted.slots[static_cast<std::size_t>(parents[i])];
    if (sorted.partOf(below) == part) continue;
    EXPECT_EQ(sorted.partOf(below), 0u);
    const ChainPart& own = sorted.parts[part];
    const int hung = own.roots.at(static_cast<std::size_t>(sorted.slots[i] - own.begin));
    EXPECT_EQ(sorted.hung.at(static_cast<std::size_t>(hung)).slot, below);
    ++cut;
  }
  EXPECT_EQ(cut, sorted.hung.size());
  for (const std::size_t each : joints) EXPECT_LE(each, 400u);
}

/// Largest difference of a bend from the plain stepper's over the largest bend.
double error(const std::vector<Link>& links, const Surroundings& around, int steps) {
  Simulation plain{links};
  BatchChain chain(links);
  for (int i = 0; i < steps; ++i) {
    plain.step(around, i * STEP, STEP);
    chain.step(around, i * STEP, STEP);
  }
  const ChainState end = chain.state(0);
  double worst = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    worst = std::max(worst, (end.q[i] - plain.state.q[i]).norm());
    largest = std::max(largest, plain.state.q[i].norm());
  }
  EXPECT_GT(largest, 1e-3);
  return worst / largest;
}

// Bars as for smaller trees: float's rounding, and the springs of a gripper that make more of it.
TEST(ChainParts, LargeTreesFollowThePlainStepper) {
  const std::vector<Link> links = fractalTree(5000, 3);
  EXPECT_LT(error(links, gustAndPull(links, 18.0, 20.0), 360), 1e-5);
  EXPECT_LT(error(links, gripper(links), 120), 2e-4);
}

TEST(ChainParts, LargeTreesStandOnSeveralBases) {
  std::vector<Link> links = fractalTree(2500, 3);
  for (const Link& link : fractalTree(2500, 4)) {
    links.push_back(link);
    links.back().parent = link.parent < 0 ? -1 : link.parent + 2500;
    if (link.parent < 0) links.back().base = 1;
  }
  Surroundings around;
  around.bases = [](double t, std::vector<BaseMotion>& bases) {
    bases.assign(2, BaseMotion());
    bases[1].pose.position = Vec3(0.2 * std::sin(4.0 * t), 5.0, 0.0);
    bases[1].velocity = Vec3(0.8 * std::cos(4.0 * t), 0.0, 0.0);
    bases[1].acceleration = Vec3(-3.2 * std::sin(4.0 * t), 0.0, 0.0);
  };
  EXPECT_LT(error(links, around, 240), 1e-5);
}

// With air in the rows a part is swept out and in before the next; with loads all are swept out
// first. The same bits, on every instruction set.
TEST(ChainParts, TheOrderOfPartsChangesNoBit) {
  const std::vector<Link> links = fractalTree(5000, 3);
  std::vector<Grip> grips;
  for (const Link& link : links) grips.push_back({link.centre, 0.01, 0.05 * link.length});
  const AskAir air = [](float* rows, std::size_t blocks) {
    for (std::size_t i = 0; i < 96 * blocks; ++i)
      if (i % 96 >= 48) rows[i] = 2.f + rows[i - 48];  // it differs from place to place
  };
  ChainState first;
  for (const std::string& set : instructionSets()) {
    forceInstructionSet(set);
    BatchChain frames(links), single(links);
    for (BatchChain* chain : {&frames, &single}) chain->setGrips(0, grips);
    for (int frame = 0; frame < 5; ++frame) {
      frames.askAir(air);
      single.askAir(air);
      frames.step(STEP, 4);
      for (int i = 0; i < 4; ++i) single.step(Surroundings(), 0.0, STEP);
    }
    forceInstructionSet("");
    EXPECT_TRUE(sameBits(frames.state(0), single.state(0))) << set;
    if (first.q.empty()) first = frames.state(0);
    EXPECT_TRUE(sameBits(frames.state(0), first)) << set;
  }
  EXPECT_GT(first.q.back().norm(), 1e-3);
}

}  // namespace
}  // namespace vegetation_sim::physics
