// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/forest/prediction_scene.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace vegetation_sim::forest {
namespace {

constexpr Nanoseconds PREDICTION_START = 1700000000LL * NANOSECONDS_PER_SECOND;

/// Trees of all species in a row, with seeds and sizes that were not used for measurements.
Layout strangers(std::uint64_t seed, int count, double spacing) {
  Layout out = gridLayout(0, spacing);
  for (int i = 0; i < count; ++i) {
    TreeSeed tree;
    tree.seed = seed + static_cast<std::uint64_t>(i);
    tree.species = static_cast<std::uint16_t>(i % 4);
    tree.scale = 0.8 + 0.07 * i;
    tree.yaw = 0.7 * i;
    tree.position = Vec3(spacing * (i - 0.5 * (count - 1)), 0.0, 0.0);
    out.trees.push_back(tree);
  }
  return out;
}

Viewpoint eyeBefore(double distance) {
  Viewpoint out;
  out.position = Vec3(0.0, -distance, 3.0);
  out.forward = Vec3::UnitY();
  out.cone_cosine = 0.2;
  return out;
}

/// Returns how many trees were predicted within a factor of two.
double shareWithinTwo(const Prediction::Looks& looks) {
  double within = 0.0;
  for (const auto& [tree, each] : looks) {
    const double ratio = Prediction::ratioOf(each);
    std::printf("tree %u on rung %d: predicted over measured %.2f\n", tree, each.back().tier,
                ratio);
    within += ratio > 0.5 && ratio < 2.0;
  }
  return within / static_cast<double>(looks.size());
}

// N7: the predicted error of the chosen tiers, procedural or modal, is that against the full chain
// within a factor of two for nine trees in ten, in breeze, oscillating disk and gust together;
// trees and wind were not used for measurements.
TEST(Prediction, OfChosenRungsIsWhatTheFullChainShows) {
  wind::Primitive gust = makeBreeze(2, Vec3(1.0, 5.0, 0.0));
  gust.name = "gust";
  gust.kind = wind::Kind::GUST;
  gust.trajectory = {{PREDICTION_START, Vec3(0.0, -80.0, 0.0)}};
  gust.epoch = PREDICTION_START;
  gust.front_speed = 9.0;
  gust.rise_length = 12.0;
  gust.radius = 100.0;
  wind::Primitive disk = makeDisk(3, Vec3(10.0, 5.0, 0.0), 40.0, Vec3(-1.5, 2.0, 0.0));
  disk.omega = 1.7;
  const wind::Field field({makeBreeze(1, Vec3(3.5, -1.5, 0.0)), gust, disk}, 77);
  Prediction scene(strangers(5000, 10, 5.0), flatTerrain(), field, eyeBefore(25.0),
                   PREDICTION_START);
  const Prediction::Looks looks = scene.look(8);
  EXPECT_EQ(looks.size(), 10u);
  EXPECT_GE(shareWithinTwo(looks), 0.9);
}

// N7: in a steady storm the response has no delay, but all lever arms are those at rest, which is
// predicted too.
TEST(Prediction, KnowsThatSteadyStormsBendLevers) {
  wind::Primitive storm = makeBreeze(1, Vec3(40.0, 0.0, 0.0));
  storm.turbulence = 0.0;
  Prediction scene(strangers(6000, 4, 8.0), flatTerrain(), wind::Field({storm}, 7), eyeBefore(20.0),
                   PREDICTION_START);
  const Prediction::Looks looks = scene.look(1);
  ASSERT_EQ(looks.size(), 4u);
  for (const auto& entry : looks) EXPECT_GT(entry.second.back().predicted, 0.0);
  EXPECT_GE(shareWithinTwo(looks), 0.9);
}

// N7: in gusts rotated lever arms correct less than in steady wind: an oak as in the shipped
// forest, which fine modes do not hold to a pixel this near, as predicted.
TEST(Prediction, KnowsThatGustsBendWhatSwings) {
  Layout layout = gridLayout(0, 1.0);
  TreeSeed oak;
  oak.seed = 4;
  oak.scale = 0.55;
  layout.trees.push_back(oak);
  wind::Primitive breeze = makeBreeze(1, Vec3(1.2, 3.0, 0.0));
  breeze.turbulence = 0.4;
  breeze.length_scale = 12.0;
  wind::Primitive gust = makeBreeze(2, Vec3(0.5, 6.0, 0.0));
  gust.name = "gust";
  gust.kind = wind::Kind::GUST;
  gust.trajectory = {{PREDICTION_START, Vec3(-4.0, -32.0, 0.0)}};
  gust.epoch = PREDICTION_START;
  gust.front_speed = 7.0;
  gust.rise_length = 4.0;
  gust.plateau_length = 6.0;
  gust.decay_length = 10.0;
  gust.repeat = 9.0;
  gust.radius = 40.0;
  Prediction scene(layout, flatTerrain(), wind::Field({breeze, gust}, 5), eyeBefore(13.0),
                   PREDICTION_START);
  const Prediction::Looks looks = scene.look(10);
  ASSERT_EQ(looks.size(), 1u);
  EXPECT_EQ(looks.at(0).back().tier, FINE_MODAL_TIER);
  EXPECT_EQ(shareWithinTwo(looks), 1.0);
}

// N11, N13: in water, quadratic drag damps by the relative velocity and couples the modes. With the
// damping of each mode alone, tips are 27 to 36 pixels from the full chain.
TEST(Prediction, ModesFollowTheFullChainInWater) {
  Layout layout;
  layout.motion.drag = Drag::QUADRATIC;
  layout.species = {shippedSpecies("giant_kelp")};
  for (int i = 0; i < 3; ++i) {
    TreeSeed kelp;
    kelp.seed = 30 + static_cast<std::uint64_t>(i);
    kelp.position = Vec3(4.0 * i - 4.0, 0.0, 0.0);
    layout.trees.push_back(kelp);
  }
  wind::Primitive current = makeBreeze(1, Vec3(0.05, 0.22, 0.0));
  current.turbulence = 0.5;
  current.length_scale = 3.0;
  wind::Primitive swell = makeDisk(2, Vec3::Zero(), 40.0, Vec3(0.1, 0.5, 0.0));
  swell.omega = 0.9;
  Prediction scene(layout, flatTerrain(), wind::Field({current, swell}, 6), eyeBefore(25.0),
                   PREDICTION_START);
  const Prediction::Looks looks = scene.look(6);
  ASSERT_EQ(looks.size(), 3u);
  for (const auto& [tree, each] : looks) {
    EXPECT_GE(each.back().tier, MODAL_LEVEL) << tree;
    double worst = 0.0;
    for (const Prediction::Look& look : each) worst = std::max(worst, look.measured);
    std::printf("kelp %u: %.1f pixels\n", tree, worst);
    EXPECT_LT(worst, 22.0) << tree;
  }
}

}  // namespace
}  // namespace vegetation_sim::forest
