// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/grass/blade_shade.h"

#include <gtest/gtest.h>

namespace vegetation_sim::view {
namespace {

TEST(BladeShade, DarkensTheVerticesInAShadowAndNoOthers) {
  grass::MapLaw law;
  law.resolution = 2.0;
  law.columns = law.rows = 6;
  BlobShadow shadow;
  shadow.centre = Vec3(3.0, 5.0, 0.0);
  shadow.first = Vec3(0.5, 0.0, 0.0);
  shadow.second = Vec3(0.0, 0.5, 0.0);
  shadow.strength = 0.5;
  BlobShadow far = shadow;
  far.centre = Vec3(1e12, -1e12, 0.0);
  const BladeShade shade(law, {&shadow, &far});
  grass::GrassMesh mesh;
  mesh.origin = Vec3(1.0, 1.0, 0.0);
  for (const float x : {2.f, 2.f, 2.8f}) {
    mesh.positions.insert(mesh.positions.end(), {x, 4.f, 0.f});
    mesh.colours.insert(mesh.colours.end(), {200, 100, 50, 255});
  }
  shade.darken(1, 2, 1, mesh);
  EXPECT_EQ(mesh.colours[0], 200) << "a vertex of an earlier tile";
  EXPECT_EQ(mesh.colours[4], 100);
  EXPECT_EQ(mesh.colours[5], 50);
  EXPECT_EQ(mesh.colours[7], 255);
  EXPECT_EQ(mesh.colours[8], 200) << "a vertex beside the shadow";
  shade.darken(4, 2, 0, mesh);
  EXPECT_EQ(mesh.colours[0], 200) << "a tile without shadows";
}

}  // namespace
}  // namespace vegetation_sim::view
