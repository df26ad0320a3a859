// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/physics/modal_forest.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/forest/modal_forest_scene.h"

namespace vegetation_sim::forest {
namespace {

// N13: modes that are computed before their state arrives are counted; they and their requests end
// with their purpose.
TEST(ModalForest, WhatIsAwaitedIsCountedAndDropped) {
  const Layout layout = gridLayout(2, 12.0);
  const terrain::HeightMap flat;
  const wind::Field wind = breeze();
  const ModalContext at{layout, flat, wind};
  LevelMap modal, still;
  for (std::uint32_t id = 0; id < 4; ++id) modal.set(id, LevelState::settled(MODAL_LEVEL));
  ModalForest source;
  for (const std::uint32_t id : {0u, 1u}) source.addTree(at, id, true, seconds(1.0));
  const std::size_t all = source.find(1)->modes().size();
  ModalForest modes;
  modes.addTree(at, 0, false, seconds(1.0));
  for (const std::uint32_t id : {0u, 1u, 2u}) modes.queueFineModes(id);
  EXPECT_EQ(modes.find(0), nullptr);  // its former state would be stale
  EXPECT_EQ(modes.bytes(), 0u);
  modes.restore(at, 0, source.find(0)->state(), seconds(1.0));  // no longer queued
  const std::size_t one = modes.bytes();
  modes.prepareNext(at);
  EXPECT_FALSE(modes.isReady(2, all));
  EXPECT_TRUE(modes.isReady(1, all));
  EXPECT_GT(modes.bytes(), one);
  modes.removeFaded(modal, seconds(1.0), 1.0);
  EXPECT_TRUE(modes.isReady(1, all));
  modes.removeFaded(still, seconds(1.0), 1.0);
  EXPECT_FALSE(modes.isReady(1, all));
  modes.prepareNext(at);  // of no tree: 2 has left modes
  EXPECT_EQ(modes.bytes(), 0u);
}

// N13: a tree with another stamp restarts on its procedural motion.
TEST(ModalForest, StartAgainWhatStandsAtAnotherStamp) {
  const Layout layout = gridLayout(2, 12.0);
  const terrain::HeightMap flat;
  const wind::Field wind = breeze();
  const ModalContext at{layout, flat, wind};
  ModalForest early, late;
  early.addTree(at, 0, false, seconds(1.0));
  late.addTree(at, 0, false, seconds(9.0));
  early.advance(wind, seconds(8.9), seconds(9.0));
  EXPECT_EQ(early.find(0)->stamp(), seconds(9.0));
  EXPECT_EQ(early.find(0)->state().amplitude, late.find(0)->state().amplitude);
}

// N13: a tree with few branches has all its modes at once; they are not computed again, and
// replicas have the same.
TEST(ModalForest, TreesOfFewBranchesHaveAllOfTheirModes) {
  const wind::Field wind = breeze();
  const terrain::HeightMap flat;
  for (const int branches : {1, 4, 8, 10, 11, 12, 15}) {
    Layout layout = gridLayout(1, 1.0);
    layout.species[0] = Species();
    layout.species[0].limbs[0].segments = branches;
    layout.species[0].limbs[0].leaves = 20.0;
    const ModalContext at{layout, flat, wind};
    ModalForest modes, late;
    modes.addTree(at, 0, false, seconds(1.0));
    EXPECT_EQ(modes.find(0)->fine(), branches <= 11) << branches;
    modes.addTree(at, 0, true, seconds(1.0));
    const ModalTreeState& here = *modes.find(0);
    EXPECT_TRUE(here.fine()) << branches;
    const ModalTree* found = &here.modes();
    modes.addTree(at, 0, true, seconds(1.0));
    EXPECT_EQ(&modes.find(0)->modes(), found) << branches;
    late.restore(at, 0, here.state(), here.stamp());
    const auto right = here.modes().bendsOf(here.state().amplitude);
    const auto there = late.find(0)->modes().bendsOf(here.state().amplitude);
    ASSERT_EQ(right.size(), static_cast<std::size_t>(branches));
    for (std::size_t b = 0; b < right.size(); ++b) {
      EXPECT_EQ(right[b].first, there[b].first) << branches;
      EXPECT_EQ(right[b].second, there[b].second) << branches;
    }
  }
}

// N13: rotated lever arms feed back on the bend; in any storm and tick length the tree stays near
// the result for lever arms at rest.
TEST(ModalForest, LeversThatTurnStayBoundedInStormsOverLongTicks) {
  const Layout layout = gridLayout(2, 12.0);
  std::vector<wind::Primitive> three;
  for (std::uint32_t id = 1; id <= 3; ++id) three.push_back(makeBreeze(id, Vec3(90.0, 10.0, 0.0)));
  const wind::Field storm(three, 3);
  const auto largestTurn = [](const ModalTreeState& modal_state) {
    return modal_state.modes().probe().largestTurn(modal_state.state().amplitude);
  };
  for (std::uint32_t id = 0; id < 4; ++id) {
    const Tree tree = growTree(layout, id, terrain::HeightMap());
    const auto modes =
        std::make_shared<const ModalTree>(tree, layout.species[tree.seed.species], FINE_MODES);
    for (const int steps : {1, 6, 60}) {  // of 1/60 s a tick
      ModalTreeState turning(modes), stiff(modes);
      std::vector<ModalLoad> loads(static_cast<std::size_t>(steps) + 1), rest;
      double most = 0.0, least = 0.0;
      for (int tick = 0; tick * steps < 20 * 60; ++tick) {
        const auto stamp = [&](int i) { return seconds(100.0 + (tick * steps + i) / 60.0); };
        for (int i = 0; i <= steps; ++i)
          turning.loadOf(storm.at(stamp(i)), loads[static_cast<std::size_t>(i)]);
        rest = loads;
        for (ModalLoad& load : rest) load.air.setZero();
        for (ModalTreeState* modal_state : {&turning, &stiff}) {
          const std::vector<ModalLoad>& of = modal_state == &turning ? loads : rest;
          if (tick == 0) modal_state->restore(modal_state->state(), of[0], stamp(0));
          modal_state->step(of, stamp(steps));
        }
        most = std::max(most, largestTurn(turning));
        least = std::max(least, largestTurn(stiff));
      }
      std::printf("tree %u, ticks of %d/60 s: %.2f rad, %.2f with levers at rest\n", id, steps,
                  most, least);
      EXPECT_LT(most, 1.5 * least) << id << " " << steps;
    }
  }
}

}  // namespace
}  // namespace vegetation_sim::forest
