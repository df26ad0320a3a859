// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/sweep.h"

#include <gtest/gtest.h>

#include <numeric>

#include "reference/sensors/binary_scene.h"
#include "reference/sensors/cast_plain.h"
#include "scenes/sensors/grove_scene.h"
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

Lidar coarse() {
  Lidar out;
  out.beams.columns = 120;
  out.model.noise = 0.0;
  return out;
}

// Trees, a lawn, leafy plants and a person between them.
void fill(Scene& scene, const Lawn& lawn) {
  const auto forest = movingForest(forest::gridLayout(2, 9.0), breezeOf(Vec3(4, 0, 0)));
  scene.trees.update(forest, Vec3(10, 10, 1), 60.0, START);
  lawn.show(scene.grass);
  Grove(groveLayout(Vec3(7.0, 12.0, 0.0))).show(scene.plants, alone);
  crowd::Walker walker;
  walker.position = {12.0, 10.0};
  scene.people.set({{7, crowd::skeletonOf(walker, terrain::HeightMap())}});
}

// N1: labels sum to totals.
TEST(Sweep, LabelsSumToTheNumberOfRays) {
  Scene scene;
  const Lawn lawn(0.15, 100.0);
  fill(scene, lawn);
  Lidar lidar = coarse();
  lidar.model.weather = {0.0, 50.0, 10.0};
  const auto returns = sweep(scene, lidar, sensorAt(Vec3(10, 10, 1.2)), {}, alone);
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
  Lidar lidar = coarse();
  lidar.model.noise = 0.02;
  const auto one = sweep(scene, lidar, sensorAt(Vec3(10, 10, 1.2)), {3, 9}, alone);
  for (const int count : {2, 3, 8}) {
    ThreadPool threads(count);
    const auto other = sweep(scene, lidar, sensorAt(Vec3(10, 10, 1.2)), {3, 9}, threads);
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i].range, other[i].range);
      EXPECT_TRUE(same(one[i].hit, other[i].hit));
    }
  }
}

// REP 117
TEST(Sweep, TooNearIsMinusInfinityAndNothingIsInfinity) {
  Scene scene;
  Lidar lidar = coarse();
  lidar.beams.range_min = 0.5;
  lidar.beams.range_max = 10.0;
  const auto near = sweep(scene, lidar, sensorAt(Vec3(0, 0, 0.05)), {}, alone);
  const auto high = sweep(scene, lidar, sensorAt(Vec3(0, 0, 9.0)), {}, alone);
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
  const Lidar lidar = coarse();
  const Beams& beams = lidar.beams;
  const auto returns = sweep(scene, lidar, sensorAt(Vec3(0, 0, 1.0)), {}, alone);
  for (int ring = 0; ring < 8; ++ring) {
    const Vec3 direction = directionOf(beams, ring, 5);
    const Return& one = returns[static_cast<std::size_t>(ring * beams.columns + 5)];
    EXPECT_EQ(one.hit.label, Label::GROUND);
    EXPECT_NEAR(one.range * direction.z(), -1.0, 1e-3);  // as near as terrain::meetGround
    EXPECT_NEAR(one.hit.cosine, -direction.z(), 1e-12);
  }
}

// A beam of 20 mrad that is centred on the edge of a post sees the post with half of its light and
// the ground behind with the rest.
TEST(Sweep, AWideBeamAtAnEdgeHasTwoReturns) {
  Scene scene;
  crowd::Skeleton post{};
  for (crowd::Limb& limb : post) limb = {Vec3(10.0, -0.2, -1.0), Vec3(10.0, -0.2, 5.0), 0.2};
  scene.people.set({{7, post}});
  Lidar lidar = coarse();
  lidar.beams.rings = 1;
  lidar.beams.columns = 1;
  lidar.beams.elevation_low = lidar.beams.elevation_high = -0.06;
  lidar.beams.azimuth_low = 0.0;
  lidar.model.shape = {0.02, 37, 3.0};
  lidar.model.returns = ReturnMode::BOTH;
  const auto both = sweep(scene, lidar, sensorAt(Vec3(0, 0, 1.2)), {}, alone);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].type, ReturnType::DUAL_STRONGEST_FIRST);
  EXPECT_EQ(both[1].type, ReturnType::DUAL_WEAK_LAST);
  EXPECT_EQ(both[0].hit.label, Label::PERSON);
  EXPECT_EQ(both[1].hit.label, Label::GROUND);
  EXPECT_NEAR(both[0].range, 10.0, 0.2);
  EXPECT_NEAR(both[1].range, 20.0, 2.0);
  EXPECT_EQ(countLabels(both, 2)[0], 0u);
  EXPECT_EQ(countLabels(both, 2)[1], 1u);
  lidar.model.shape.samples = 1;
  const auto narrow = sweep(scene, lidar, sensorAt(Vec3(0, 0.1, 1.2)), {}, alone);
  EXPECT_EQ(narrow[0].type, ReturnType::DUAL_ONLY);
  EXPECT_FALSE(narrow[1].isPoint());
}

// A sensor on its side, above flat ground, sinks at 5 m/s while it turns by 0.2 rad about the
// vertical: each range is the present height over the ray's slope, and all places at the beginning
// lie on the ground.
TEST(Sweep, ASensorThatMovesMeasuresFromWhereItIs) {
  const Scene scene;
  Lidar lidar = coarse();
  lidar.beams.rings = 1;
  lidar.beams.elevation_low = lidar.beams.elevation_high = 0.0;
  const double h = std::sqrt(0.5);
  Pose begin = sensorAt(Vec3(0, 0, 4.0)), end = sensorAt(Vec3(0.3, 0, 3.5));
  begin.orientation = {h, h, 0.0, 0.0};  // y upwards
  const SinCos half = sinCos(0.1);
  end.orientation = Quat{half.cos, 0.0, 0.0, half.sin} * begin.orientation;
  const SensorPath path(begin, end, 0.1);
  const auto returns = sweep(scene, lidar, path, {}, alone);
  int met = 0;
  for (int column = 0; column < lidar.beams.columns; ++column) {
    const Return& one = returns[static_cast<std::size_t>(column)];
    const Vec3 ray = directionOf(lidar.beams, 0, column);
    if (!(ray.y() < -0.2)) continue;
    ++met;
    const double time = 0.1 * column / lidar.beams.columns;
    EXPECT_NEAR(one.range, (4.0 - 5.0 * time) / -ray.y(), 1e-3 / -ray.y());
    const Vec3 place = path.toBegin(time, one.range * ray);
    EXPECT_NEAR((begin.position + rotate(begin.orientation, place)).z(), 0.0, 1e-3);
  }
  EXPECT_GT(met, 40);
}

}  // namespace
}  // namespace vegetation_sim::scan
