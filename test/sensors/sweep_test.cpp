// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/sweep.h"

#include <gtest/gtest.h>

#include <numeric>

#include "reference/sensors/binary_scene.h"
#include "reference/sensors/cast_plain.h"
#include "scenes/sensors/lidar_scene.h"
#include "vegetation_sim/core/config/instruction_set.h"

namespace vegetation_sim::scan {
namespace {

ThreadPool alone;

Pose sensorAt(const Vec3& place) {
  Pose out;
  out.position = place;
  return out;
}

Beams coarse() {
  Beams out;
  out.columns = 120;
  out.noise = 0.0;
  return out;
}

// Trees, a lawn and a person between them.
void fill(Scene& scene, const Lawn& lawn) {
  const auto forest = movingForest(forest::gridLayout(2, 9.0), breezeOf(Vec3(4, 0, 0)));
  scene.trees.update(forest, Vec3(10, 10, 1), 60.0, START);
  lawn.show(scene.grass);
  crowd::Walker walker;
  walker.position = {12.0, 10.0};
  scene.people.set({{7, crowd::skeletonOf(walker, terrain::HeightMap())}});
}

// N1: labels sum to totals.
TEST(Sweep, LabelsSumToTheNumberOfRays) {
  Scene scene;
  const Lawn lawn(0.15, 100.0);
  fill(scene, lawn);
  const auto returns = sweep(scene, coarse(), sensorAt(Vec3(10, 10, 1.2)), {}, alone);
  ASSERT_EQ(returns.size(), 16u * 120u);
  const auto counts = countLabels(returns);
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0u), 16u * 120u);
  for (std::size_t label = 0; label < LABELS; ++label) EXPECT_GT(counts[label], 0u) << label;
  for (const Return& one : returns) {
    if (one.hit.label == Label::PERSON) {
      EXPECT_EQ(one.hit.plant, 7u);
    }
  }
}

TEST(Sweep, FindsWhatLookingAtEverythingFinds) {
  Scene scene;
  const Lawn lawn;
  fill(scene, lawn);
  const BinaryScene binary(scene);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Ray ray(Vec3(10, 10, 1.2), randomDirection(Random(6), i, -0.5, 0.5));
    const Hit plain = castPlain(scene, ray, 40.0);
    EXPECT_TRUE(same(binary.cast(ray, 40.0), plain)) << i;
    for (const std::string& set : instructionSets()) {
      forceInstructionSet(set);
      EXPECT_TRUE(same(cast(scene, ray, 40.0), plain)) << i << " " << set;
    }
  }
  forceInstructionSet("");
}

TEST(Sweep, IsTheSameForAnyNumberOfThreads) {
  Scene scene;
  const Lawn lawn;
  fill(scene, lawn);
  Beams beams = coarse();
  beams.noise = 0.02;
  const auto one = sweep(scene, beams, sensorAt(Vec3(10, 10, 1.2)), {3, 9}, alone);
  for (const int count : {2, 3, 8}) {
    ThreadPool threads(count);
    const auto other = sweep(scene, beams, sensorAt(Vec3(10, 10, 1.2)), {3, 9}, threads);
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i].range, other[i].range);
      EXPECT_TRUE(same(one[i].hit, other[i].hit));
    }
  }
}

// REP 117
TEST(Sweep, TooNearIsMinusInfinityAndNothingIsInfinity) {
  Scene scene;
  Beams beams = coarse();
  beams.range_min = 0.5;
  beams.range_max = 10.0;
  const auto near = sweep(scene, beams, sensorAt(Vec3(0, 0, 0.05)), {}, alone);
  const auto high = sweep(scene, beams, sensorAt(Vec3(0, 0, 9.0)), {}, alone);
  const auto infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(near.front().range, -infinity);  // the lowest ring
  EXPECT_EQ(near.back().range, infinity);
  EXPECT_EQ(high.front().range, infinity);
  for (const auto* all : {&near, &high})
    for (const Return& one : *all) EXPECT_FALSE(std::isnan(one.range));
  EXPECT_EQ(countLabels(near)[0] + countLabels(near)[1], near.size());
}

TEST(Sweep, GroundIsMetWhereItIs) {
  const Scene scene;
  const Beams beams = coarse();
  const auto returns = sweep(scene, beams, sensorAt(Vec3(0, 0, 1.0)), {}, alone);
  for (int ring = 0; ring < 8; ++ring) {
    const Vec3 direction = directionOf(beams, ring, 5);
    const Return& one = returns[static_cast<std::size_t>(ring * beams.columns + 5)];
    EXPECT_EQ(one.hit.label, Label::GROUND);
    EXPECT_NEAR(one.range * direction.z(), -1.0, 1e-3);  // as near as terrain::meetGround
    EXPECT_NEAR(one.hit.cosine, -direction.z(), 1e-12);
  }
}

TEST(Sweep, NoiseHasMeanZeroAndItsDeviation) {
  double sum = 0.0, square = 0.0;
  constexpr int N = 20000;
  for (std::uint64_t i = 0; i < N; ++i) {
    const double x = unitNoise({4, i % 7}, i);
    EXPECT_LE(std::fabs(x), 6.0);
    sum += x;
    square += x * x;
  }
  EXPECT_NEAR(sum / N, 0.0, 4.0 / std::sqrt(N));
  EXPECT_NEAR(square / N, 1.0, 4.0 * std::sqrt(2.0 / N));
  EXPECT_EQ(unitNoise({4, 1}, 2), unitNoise({4, 1}, 2));
  EXPECT_NE(unitNoise({4, 1}, 2), unitNoise({4, 2}, 2));
  EXPECT_NE(unitNoise({4, 1}, 2), unitNoise({5, 1}, 2));
  EXPECT_NE(unitNoise({4, 1}, 2), unitNoise({4, 1, 1}, 2));
}

TEST(Sweep, RaysStandWhereTheyAreAskedFor) {
  Beams beams;
  beams.rings = 3;
  beams.columns = 4;
  beams.elevation_low = -0.2;
  beams.elevation_high = 0.2;
  beams.azimuth_low = -PI;
  beams.azimuth_high = PI;
  EXPECT_NEAR((directionOf(beams, 1, 2) - Vec3(1, 0, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((directionOf(beams, 1, 3) - Vec3(0, 1, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(directionOf(beams, 0, 0).z(), -std::sin(0.2), 1e-12);
  EXPECT_NEAR(directionOf(planeOf(beams), 0, 1).z(), 0.0, 1e-15);
}

TEST(Sweep, InvalidBeamsAreRejected) {
  Beams beams;
  beams.elevation_low = 0.3;
  beams.azimuth_high = beams.azimuth_low;
  beams.range_min = 80.0;
  Faults faults;
  check(beams, "", faults);
  const std::string text = faults.text();
  for (const char* name : {"elevation_high", "azimuth_high", "range_max"})
    EXPECT_NE(text.find(std::string(name) + " = "), std::string::npos) << text;
  beams = Beams();
  beams.azimuth_low = -6.0;
  beams.azimuth_high = 6.0;
  Faults turn;
  check(beams, "", turn);
  EXPECT_NE(turn.text().find("more than a turn"), std::string::npos);
}

}  // namespace
}  // namespace vegetation_sim::scan
