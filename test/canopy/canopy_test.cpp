// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/canopy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error_text.h"
#include "scenes/canopy/canopy_scene.h"
#include "vegetation_sim/core/config/instruction_set.h"

namespace vegetation_sim::canopy {
namespace {

std::vector<Vec3> tipsOf(const Foliage& foliage, const Layout& layout) {
  std::vector<Vec3> out;
  for (std::size_t plant = 0; plant < layout.plants.size(); ++plant)
    for (const Leaf& leaf : grow(layout.kinds[0], layout.plants[plant]).leaves)
      out.push_back(foliage.move(leaf, plant).tip - leaf.tip);
  return out;
}

// S3-08, S3-12: leaves lean the way that the wind law blows, across and in depth.
TEST(Canopy, LeansWithTheSharedWind) {
  for (const double side : {1.0, -1.0}) {
    Canopy canopy(shrubScene());
    canopy.setWind(breezeFrom(Vec3(0.0, 5.0 * side, 0.0)));  // to the left in the picture
    run(canopy, 0, 200);
    double sum = 0.0;
    const std::vector<Vec3> tips = tipsOf(canopy.foliage(), canopy.layout());
    for (const Vec3& tip : tips) sum += tip.y();
    EXPECT_GT(side * sum / static_cast<double>(tips.size()), 0.02);
  }
  Canopy canopy(shrubScene());
  canopy.setWind(breezeFrom(Vec3(6.0, 0.0, 0.0)));  // into the picture: shorter, and from the front
  run(canopy, 0, 200);
  EXPECT_GT(std::fabs(canopy.oscillator().depth()), 1.0);
  EXPECT_EQ(canopy.snapshot().driver.share(), 1.0);
  canopy.setWind(breezeFrom(Vec3(-6.0, 0.0, 0.0)));
  run(canopy, 200, 400);
  EXPECT_EQ(canopy.snapshot().driver.share(), 0.0);  // S3-23
}

// Of the top of a shrub over five swells of a side wind, about its mean [m].
double swingAt(int rate) {
  Layout layout = shrubScene();
  layout.motion.rate = rate;
  layout.motion.sources.law_gain = layout.motion.sources.turbulence = 0.0;
  layout.motion.sources.sides[0] = {6.0, 0.5};
  Canopy canopy(layout);
  const Vec3 foot = layout.plants[0].position, top = foot + Vec3(0.0, 0.0, 1.4);
  double sum = 0.0, squares = 0.0;
  for (int tick = 0; tick < 20 * rate; ++tick) {
    canopy.advance(tickStamp(0) + tick * NANOSECONDS_PER_SECOND / rate);
    if (tick < 10 * rate) continue;
    const double y = canopy.foliage().displacement(top, top, 0).y();
    sum += y, squares += y * y;
  }
  const double count = 10.0 * rate;
  return std::sqrt(squares / count - (sum / count) * (sum / count));
}

// E10: air, leaves and layers, not the warp alone, whose printed form would give a half and a
// quarter. What is left, half a percent, is the sources' step.
TEST(Canopy, MovesTheSameAtAnyRate) {
  const double swing = swingAt(60);
  EXPECT_GT(swing, 0.005);
  for (const int rate : {120, 30, 15}) EXPECT_NEAR(swingAt(rate) / swing, 1.0, 0.01) << rate;
}

TEST(Canopy, StandsStillInACalm) {
  Canopy canopy(shrubScene());
  run(canopy, 0, 60);
  for (const Vec3& tip : tipsOf(canopy.foliage(), canopy.layout()))
    EXPECT_EQ(tip, Vec3(0.0, 0.0, 0.0));
}

// S3-24: leaves on the ground do not move, those on top do.
TEST(Canopy, MovesFreelyAtTheTopAndNotAtTheFoot) {
  Canopy canopy(shrubScene());
  canopy.setWind(breezeFrom(Vec3(0.0, 5.0, 0.0)));
  run(canopy, 0, 200);
  const Vec3 foot = canopy.layout().plants[0].position, top = foot + Vec3(0.0, 0.0, 1.6);
  EXPECT_EQ(length(canopy.foliage().displacement(foot, foot, 0)), 0.0);
  EXPECT_GT(length(canopy.foliage().displacement(top, top, 0)), 0.02);
  for (const Vec3& tip : tipsOf(canopy.foliage(), canopy.layout()))
    EXPECT_LT(length(tip), 0.4 * 1.6 / 1.5 + 1e-9);
}

// S3-31: grouping (neighbours alike), similarity and occlusion (layers alike, but not the same).
TEST(Canopy, MovesNeighboursTogetherAndLayersApart) {
  Canopy canopy(shrubScene());
  canopy.setWind(breezeFrom(Vec3(0.0, 5.0, 0.0)));
  run(canopy, 0, 100);
  double near_near = 0.0, near_far = 0.0, near_2 = 0.0, far_2 = 0.0, near_mean = 0.0,
         far_mean = 0.0, beside = 0.0;
  constexpr int COUNT = 400;
  std::vector<double> front, back;
  for (int tick = 100; tick < 100 + COUNT; ++tick) {
    canopy.advance(tickStamp(tick));
    const Foliage& foliage = canopy.foliage();
    const Vec3 place(-0.9, 0.0, 1.4), behind(2.9, 0.0, 1.4);
    front.push_back(foliage.motion(place, place).x());
    back.push_back(foliage.motion(behind, behind).x());
    near_mean += front.back() / COUNT;
    far_mean += back.back() / COUNT;
    beside += std::fabs(front.back() - foliage.motion(place, place + Vec3(0, 0.1, 0.05)).x());
  }
  for (std::size_t i = 0; i < front.size(); ++i) {
    near_near += (front[i] - near_mean) * (back[i] - far_mean);
    near_2 += std::pow(front[i] - near_mean, 2);
    far_2 += std::pow(back[i] - far_mean, 2);
    near_far += std::fabs(front[i] - back[i]);
  }
  const double correlation = near_near / std::sqrt(near_2 * far_2);
  EXPECT_GT(correlation, 0.0);
  EXPECT_LT(correlation, 0.995);
  EXPECT_LT(beside, 0.7 * near_far);
}

// S3-28: the tick knows no leaf: a thousand times as many, the same bits, the same memory.
TEST(Canopy, CostsTheSameForAnyNumberOfLeaves) {
  Layout few = shrubScene(), many = shrubScene();
  many.kinds[0].leaves = 200000;
  Canopy a(few), b(many);
  for (Canopy* canopy : {&a, &b}) {
    canopy->setWind(breezeFrom(Vec3(0.0, 5.0, 0.0)));
    run(*canopy, 0, 30);
  }
  EXPECT_EQ(a.snapshot().hash(), b.snapshot().hash());
}

// N6: same inputs, same hash, on every instruction set; a snapshot goes on to the same bits.
TEST(Canopy, RepeatsItselfToTheBit) {
  std::vector<std::uint64_t> hashes;
  for (const std::string& name : instructionSets()) {
    forceInstructionSet(name);
    Canopy canopy(shrubScene());
    canopy.setWind(breezeFrom(Vec3(1.0, 5.0, 0.0)));
    run(canopy, 0, 60);
    hashes.push_back(canopy.snapshot().hash());
  }
  forceInstructionSet("");
  for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes.front());
  Canopy first(shrubScene()), second(shrubScene());
  for (Canopy* canopy : {&first, &second}) canopy->setWind(breezeFrom(Vec3(1.0, 5.0, 0.0)));
  run(first, 0, 30);
  second.restore(first.snapshot());
  EXPECT_EQ(first.snapshot().hash(), second.snapshot().hash());
  for (Canopy* canopy : {&first, &second}) run(*canopy, 30, 60);
  EXPECT_EQ(first.snapshot().hash(), second.snapshot().hash());
  EXPECT_EQ(first.snapshot().hash(), hashes.front());
  second.reset();
  run(second, 0, 60);
  EXPECT_EQ(second.snapshot().hash(), hashes.front());
}

TEST(Canopy, TakesStandingTimeAndGaps) {
  Canopy canopy(shrubScene());
  canopy.setWind(breezeFrom(Vec3(1.0, 5.0, 0.0)));
  run(canopy, 0, 30);
  const std::uint64_t before = canopy.snapshot().hash();
  canopy.advance(tickStamp(29));
  canopy.advance(tickStamp(5));
  EXPECT_EQ(canopy.snapshot().hash(), before);
  canopy.advance(tickStamp(29) + 10 * NANOSECONDS_PER_SECOND);
  EXPECT_EQ(canopy.figures().resets, 0U);
  canopy.advance(tickStamp(29) + 7200 * NANOSECONDS_PER_SECOND);
  for (const Vec3& tip : tipsOf(canopy.foliage(), canopy.layout()))
    ASSERT_TRUE(std::isfinite(length(tip)));
}

// S3-04: as the viewer goes round, layers are cut anew and nothing jumps.
TEST(Canopy, CrossFadesToNewLayersAsTheViewerMoves) {
  Canopy canopy(shrubScene());
  canopy.setWind(breezeFrom(Vec3(1.0, 5.0, 0.0)));
  run(canopy, 0, 100);
  const Layout& layout = canopy.layout();
  std::vector<Vec3> last = tipsOf(canopy.foliage(), layout);
  const double usual = [&] {
    double out = 0.0;
    for (int tick = 100; tick < 160; ++tick) {
      canopy.advance(tickStamp(tick));
      const std::vector<Vec3> now = tipsOf(canopy.foliage(), layout);
      for (std::size_t i = 0; i < now.size(); ++i) out = std::max(out, length(now[i] - last[i]));
      last = now;
    }
    return out;
  }();
  const CutView before = canopy.snapshot().cuts.now;
  double largest = 0.0;
  for (int tick = 160; tick < 280; ++tick) {
    const SinCos turn = sinCosTurns(0.25 * (tick - 160) / 120.0),
                 half = sinCosTurns(0.125 * (tick - 160) / 120.0);
    canopy.setViewer(
        CutView{Vec3(1.0 - 6.0 * turn.cos, -6.0 * turn.sin, 1.5), {half.cos, 0.0, 0.0, half.sin}});
    canopy.advance(tickStamp(tick));
    const std::vector<Vec3> now = tipsOf(canopy.foliage(), layout);
    for (std::size_t i = 0; i < now.size(); ++i)
      largest = std::max(largest, length(now[i] - last[i]));
    last = now;
  }
  EXPECT_GT(length(canopy.snapshot().cuts.now.position - before.position), 4.0);
  EXPECT_LT(largest, 3.0 * usual);
}

// Sensors read the leaves as seen by the plane, so that a viewer changes nothing of them.
TEST(Canopy, AViewerChangesNeitherTheHashNorTheLeavesOfSensors) {
  std::vector<std::uint64_t> hashes;
  std::vector<std::vector<Vec3>> leaves;
  for (const bool is_watched : {false, true}) {
    Canopy canopy(shrubScene());
    Replica replica(canopy.layout());
    canopy.setWind(breezeFrom(Vec3(1.0, 5.0, 0.0)));
    for (int tick = 0; tick < 120; ++tick) {
      if (is_watched && tick >= 30)
        canopy.setViewer(CutView{Vec3(8.0 - 0.2 * tick, 6.0, 1.5), {0.8, 0.0, 0.0, 0.6}});
      canopy.advance(tickStamp(tick));
      replica.apply(canopy.update(false));
    }
    EXPECT_EQ(canopy.snapshot().cuts.now.position.y() == 6.0, is_watched);
    hashes.push_back(canopy.snapshot().hash());
    leaves.push_back(tipsOf(replica.foliageOfPlane(), canopy.layout()));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  for (std::size_t i = 0; i < leaves[0].size(); ++i)
    ASSERT_EQ(length(leaves[0][i] - leaves[1][i]), 0.0);
}

// S3-29: parameters change while it runs, and nothing jumps.
TEST(Canopy, GoesOnMovingWhenItsMotionIsChanged) {
  Canopy canopy(shrubScene());
  canopy.setWind(breezeFrom(Vec3(1.0, 5.0, 0.0)));
  run(canopy, 0, 100);
  const std::uint64_t before = canopy.snapshot().hash();
  Motion motion = canopy.layout().motion;
  motion.oscillator.frequency = 3.0;
  motion.sources.sides[0].strength = 4.0;
  motion.cuts.near_layers = 5;
  const std::uint64_t layout = canopy.layoutHash();
  canopy.setMotion(motion);
  EXPECT_EQ(canopy.snapshot().hash(), before);
  EXPECT_NE(canopy.layoutHash(), layout);
  EXPECT_EQ(canopy.foliage().layers(), 5);
  Canopy other(shrubScene());
  other.setWind(breezeFrom(Vec3(1.0, 5.0, 0.0)));
  run(other, 0, 101);
  run(canopy, 100, 101);
  EXPECT_NE(canopy.snapshot().hash(), other.snapshot().hash());
  for (const auto change : {+[](Motion& m) { m.plane.distance = 9.0; },
                            +[](Motion& m) { m.fluid.cells = 64; }, +[](Motion& m) { m.rate = 20; },
                            +[](Motion& m) { m.oscillator.integrator = LeafIntegrator::VERLET; },
                            +[](Motion& m) { m.layers.memory = 2.0; }}) {
    Motion bad = motion;
    change(bad);
    EXPECT_THROW(canopy.setMotion(bad), InvalidInput);
  }
  EXPECT_EQ(canopy.layout().motion.fluid.cells, 32);
}

// Camera inside the foliage, behind it, edge-on, one layer, no depth, no plants at all.
TEST(Canopy, IsFiniteFromAnyViewAndWithAnyLayers) {
  for (const Vec3& eye : {Vec3(0.0, 0.0, 0.8), Vec3(50.0, 0.0, 1.0), Vec3(0.0, -8.0, 1.0)})
    for (const int layers : {1, 3}) {
      Layout layout = shrubScene();
      layout.motion.cuts.near_layers = layers;
      layout.motion.cuts.mid_layers = layout.motion.cuts.far_layers = 0;
      Canopy canopy(layout);
      canopy.setWind(breezeFrom(Vec3(1.0, 5.0, 0.0)));
      const double edge_on = std::sqrt(0.5);
      canopy.setViewer(CutView{eye, {edge_on, 0.0, 0.0, edge_on}});
      run(canopy, 0, 60);
      for (const Vec3& tip : tipsOf(canopy.foliage(), layout)) ASSERT_LT(length(tip), 1.0);
    }
  Layout empty = shrubScene();
  empty.plants.clear();
  Canopy canopy(empty);
  run(canopy, 0, 3);
  EXPECT_EQ(canopy.foliage().layers(), 1);
}

// Idea 3: a replica moves every leaf to the same bits, at once if it hears the first tick, else
// when it has heard the length of the history.
TEST(Replica, MovesEveryLeafAsTheAnimatorDoes) {
  Canopy canopy(shrubScene());
  canopy.setWind(breezeFrom(Vec3(2.0, 5.0, 0.0)));
  Replica early(canopy.layout()), late(canopy.layout());
  for (int tick = 0; tick < 100; ++tick) {
    canopy.advance(tickStamp(tick));
    early.apply(canopy.update(false));
    if (tick >= 50) late.apply(canopy.update(false));
    EXPECT_TRUE(early.exact());
    EXPECT_EQ(late.exact(), tick >= 50 + historyFrames(canopy.layout().motion) - 1);
  }
  const std::vector<Vec3> want = tipsOf(canopy.foliage(), canopy.layout());
  EXPECT_EQ(tipsOf(early.foliage(), canopy.layout()), want);
  EXPECT_EQ(tipsOf(late.foliage(), canopy.layout()), want);
  EXPECT_GT(length(want[0]), 0.0);
}

TEST(Replica, RejectsAnotherLayout) {
  Canopy canopy(shrubScene());
  canopy.advance(tickStamp(0));
  Layout other = shrubScene();
  other.seed = 6;
  Replica replica(other);
  EXPECT_NE(errorOf([&] { replica.apply(canopy.update(true)); }).find("layout_hash"),
            std::string::npos);
  Canopy another(shrubScene(64));
  EXPECT_THROW(another.restore(canopy.snapshot()), InvalidInput);
}

}  // namespace
}  // namespace vegetation_sim::canopy
