// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/ground/blob_shadow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "package_folder.h"

namespace vegetation_sim::view {
namespace {

const Vec3 WEST_SUN = Vec3(-1.0, 0.0, 1.0).normalized();

ShadowBox boxAt(double z) {
  return {{1.0, 2.0, z}, {Vec3(0.4, 0.0, 0.0), Vec3(0.0, 0.2, 0.0), Vec3(0.0, 0.0, 0.1)}};
}

TEST(BlobShadow, AContactShadowLiesBelowItsBoxAndIsFainterFarBelow) {
  const terrain::HeightMap flat;
  const auto standing = contactShadow(boxAt(0.1), 0.6, flat);
  ASSERT_TRUE(standing);
  EXPECT_NEAR(length(standing->centre - Vec3(1.0, 2.0, 0.0)), 0.0, 1e-12);
  EXPECT_NEAR(standing->strength, 0.6, 1e-12);
  EXPECT_GT(length(standing->first), 0.4);
  EXPECT_LT(length(standing->first), 0.6);
  EXPECT_GT(length(standing->second), 0.2);
  EXPECT_LT(length(standing->second), 0.35);
  const auto raised = contactShadow(boxAt(0.4), 0.6, flat);
  ASSERT_TRUE(raised);
  EXPECT_LT(raised->strength, 0.5 * standing->strength);
  EXPECT_GT(length(raised->second), length(standing->second));
  EXPECT_FALSE(contactShadow(boxAt(5.0), 0.6, flat));
  EXPECT_FALSE(contactShadow(boxAt(-1.0), 0.6, flat)) << "a box below the ground";
}

TEST(BlobShadow, TheShadowOfTheSunLiesOppositeToIt) {
  const terrain::HeightMap flat;
  const auto shadow = sunShadow(boxAt(1.0), WEST_SUN, 0.5, flat);
  ASSERT_TRUE(shadow);
  EXPECT_NEAR(length(shadow->centre - Vec3(2.0, 2.0, 0.0)), 0.0, 1e-9);
  EXPECT_FALSE(sunShadow(boxAt(50.0), WEST_SUN, 0.5, flat)) << "far above the ground";
  EXPECT_FALSE(sunShadow(boxAt(1.0), WEST_SUN, 0.0, flat)) << "there is no sunlight";
}

// A blade in the shadow is dark at every height at which the ray to the sun meets the box.
TEST(BlobShadow, ShadesWhatStandsInIt) {
  const terrain::HeightMap flat;
  const BlobShadow shadow = *sunShadow(boxAt(1.0), WEST_SUN, 0.5, flat);
  EXPECT_NEAR(shadeAt(shadow, shadow.centre), 0.5, 1e-9);
  EXPECT_EQ(shadeAt(shadow, shadow.centre + Vec3(3.0, 0.0, 0.0)), 0.0);
  const double above = shadeAt(shadow, shadow.centre + 0.2 * WEST_SUN);
  EXPECT_GT(above, 0.4);
  EXPECT_LT(shadeAt(shadow, shadow.centre + 0.2 * Vec3::UnitZ()), above);
}

// Rows of plants stand more closely than their shadows are wide.
TEST(BlobShadow, ManyThatOverlapAreAsDarkAsOne) {
  const terrain::HeightMap flat;
  const BlobShadow one = *contactShadow(boxAt(0.1), 0.5, flat);
  std::vector<BlobShadow> row(20, one), lone{one};
  for (int i = 0; i < 20; ++i) row[static_cast<std::size_t>(i)].centre.x() += 0.1 * i;
  shareDarkness(lone);
  EXPECT_DOUBLE_EQ(lone[0].strength, 0.5);
  const Vec3 middle = row[10].centre;
  const auto lightIn = [&] {
    double left = 1.0;
    for (const BlobShadow& shadow : row) left *= 1.0 - shadeAt(shadow, middle);
    return left;
  };
  EXPECT_LT(lightIn(), 0.25);
  shareDarkness(row);
  EXPECT_NEAR(lightIn(), 0.5, 0.15);
}

TEST(BlobShadow, FollowsTheSlopeOfTheGround) {
  const terrain::HeightMap hills =
      terrain::HeightMap::load(std::string(PACKAGE_FOLDER) + "/config/terrain/hills.yaml");
  double x = hills.bounds().min_x + 0.3;
  const double y = 0.5 * (hills.bounds().min_y + hills.bounds().max_y) + 0.2;
  while (hills.normal(x, y).z() > 0.998 && x < hills.bounds().max_x) x += 1.0;
  ASSERT_LT(x, hills.bounds().max_x) << "the hills are level";
  ShadowBox box = boxAt(0.0);
  box.centre = Vec3(x, y, hills.height(x, y) + 0.1);
  const auto shadow = contactShadow(box, 0.6, hills);
  ASSERT_TRUE(shadow);
  grass::GrassMesh mesh;
  mesh.origin = shadow->centre;
  appendShadow(*shadow, hills, mesh);
  ASSERT_GT(mesh.vertexCount(), 4u);
  double lowest = 1.0, highest = -1.0;
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    const double px = x + static_cast<double>(mesh.positions[i]);
    const double py = y + static_cast<double>(mesh.positions[i + 1]);
    const double pz = mesh.origin.z() + static_cast<double>(mesh.positions[i + 2]);
    EXPECT_NEAR(pz, hills.height(px, py) + 0.02, 1e-4);
    lowest = std::min(lowest, pz - mesh.origin.z());
    highest = std::max(highest, pz - mesh.origin.z());
  }
  EXPECT_GT(highest - lowest, 0.01);
  EXPECT_NEAR(shadeAt(*shadow, shadow->centre + 0.5 * shadow->first), 0.6 * 0.84375, 1e-6);
}

}  // namespace
}  // namespace vegetation_sim::view
