// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/sensor_scene.h"

#include <gtest/gtest.h>

#include "scenes/sensors/lidar_scene.h"
#include "sensors/lidar.h"

namespace vegetation_sim::scan {
namespace {

// N1
TEST(RayCaster, GivesTheHitsOfRaysThatAreCastAlone) {
  const wind::Field wind = breezeOf(Vec3(6, 2, 0));
  const auto forest = movingForest(forest::gridLayout(4, 7.0), wind);
  Lawn lawn;
  Scene scene;
  const Vec3 sensor(6.0, 5.0, 1.2);
  scene.trees.update(forest, sensor, 60.0, START + fromSeconds(3.0));
  lawn.show(scene.grass, wind, 3.0);
  Beams beams;
  beams.rings = 24;
  beams.columns = 360;
  std::vector<Ray> rays;
  for (int ring = 0; ring < beams.rings; ++ring)
    for (int column = 0; column < beams.columns; ++column)
      rays.emplace_back(sensor, directionOf(beams, ring, column));
  for (const GrassGrain grain : {GrassGrain::CUBES, GrassGrain::BLADES}) {
    RayCaster caster(scene, 60.0, grain);
    const std::vector<Hit>& hits = caster.cast(rays);
    std::array<int, LABELS> labels{};
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Hit alone = cast(scene, rays[i], 60.0, grain);
      EXPECT_TRUE(same(hits[i], alone)) << i;
      ++labels[static_cast<std::size_t>(alone.label)];
    }
    for (const Label label : {Label::NONE, Label::GRASS, Label::BRANCH, Label::LEAF})
      EXPECT_GT(labels[static_cast<std::size_t>(label)], 50) << static_cast<int>(label);
  }
}

}  // namespace
}  // namespace vegetation_sim::scan
