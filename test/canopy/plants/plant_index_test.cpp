// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/plants/plant_index.h"

#include <gtest/gtest.h>

#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::canopy {
namespace {

int nearestOfAll(const std::vector<Plant>& plants, const Vec3& place) {
  int out = -1;
  double least = 0.0;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    const Vec3 offset = plants[i].position - place;
    const double square = offset.x() * offset.x() + offset.y() * offset.y();
    if (out >= 0 && square >= least) continue;
    out = static_cast<int>(i);
    least = square;
  }
  return out;
}

// Scattered plants, a row, and several at one place, asked for within, on and far beyond them.
TEST(PlantIndex, FindsWhatLookingAtAllPlantsFinds) {
  const Random random(4);
  std::vector<Plant> plants(3000);
  for (std::size_t i = 0; i < plants.size(); ++i) {
    Vec3& at = plants[i].position;
    at = Vec3(random.uniform(3 * i, -50.0, 50.0), random.uniform(3 * i + 1, -8.0, 8.0), 1.0 * i);
    if (i % 3 == 0) at.y() = 2.0;
    if (i % 5 == 0) at = Vec3(10.0, 2.0, 0.0);
    if (i % 7 == 0) at = Vec3(static_cast<int>(at.x()), static_cast<int>(at.y()), 0.0);
  }
  const PlantIndex index(plants);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const double far = i % 10 == 0 ? 1e5 : 1.0;
    Vec3 place(random.uniform(2 * i + 20000, -60.0, 60.0) * far,
               random.uniform(2 * i + 20001, -10.0, 10.0) * far, 3.0);
    if (i % 4 == 0) place = Vec3(static_cast<int>(place.x()), 0.5, 0.0);  // between several
    ASSERT_EQ(index.nearest(place), nearestOfAll(plants, place)) << i;
  }
  EXPECT_EQ(index.nearest(Vec3(10.0, 2.0, 0.0)), 0);
}

TEST(PlantIndex, HasNothingToFindWithoutPlants) {
  EXPECT_EQ(PlantIndex({}).nearest(Vec3::Zero()), -1);
  EXPECT_EQ(PlantIndex(std::vector<Plant>(1)).nearest(Vec3(1e7, -1e7, 0.0)), 0);
}

}  // namespace
}  // namespace vegetation_sim::canopy
