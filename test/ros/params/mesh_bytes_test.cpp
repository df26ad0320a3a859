// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/mesh_bytes.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error_text.h"

namespace vegetation_sim {
namespace {

canopy::LeafMesh meshWithALook() {
  canopy::LeafMesh out;
  out.vertices = {Vec3(0.0, 0.5, 1.0), Vec3(1.0, -0.0, 2.0),
                  Vec3(std::numeric_limits<double>::quiet_NaN(), 1e300, 3.0)};
  out.uv = {{0.0, 0.25}, {1.0, 0.5}, {0.5, -7.0}};
  out.normals = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  out.faces = {{0, 1, 2}, {2, 1, 0}};
  out.rigid = {true, false};
  out.materials.resize(2);
  out.materials[0].colour = Vec3(0.1, 0.2, 0.3);
  out.materials[1].texture = "leaf.png";
  out.material = {2, 0};
  return out;
}

std::string errorOfBytes(const std::string& bytes) {
  return errorOf([&] { meshOfBytes(bytes); });
}

TEST(MeshBytes, HaveEveryBitOfAMesh) {
  const canopy::LeafMesh mesh = meshWithALook();
  const std::string bytes = toBytes(mesh);
  const canopy::LeafMesh read = meshOfBytes(bytes);
  EXPECT_EQ(toBytes(read), bytes);  // not all numbers equal themselves
  EXPECT_EQ(read.vertices[1], mesh.vertices[1]);
  EXPECT_EQ(read.uv, mesh.uv);
  EXPECT_EQ(read.normals, mesh.normals);
  EXPECT_EQ(read.faces, mesh.faces);
  EXPECT_EQ(read.rigid, mesh.rigid);
  EXPECT_EQ(read.material, mesh.material);
  ASSERT_EQ(read.materials.size(), 2U);
  EXPECT_EQ(read.materials[0].colour, mesh.materials[0].colour);
  EXPECT_EQ(read.materials[1].texture, "leaf.png");
  EXPECT_TRUE(meshOfBytes(toBytes({})).faces.empty());
}

TEST(MeshBytes, DamagedOnesAreRejected) {
  const std::string bytes = toBytes(meshWithALook());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_NE(errorOfBytes(bytes.substr(0, size)), "") << size;
  EXPECT_NE(errorOfBytes(bytes + "x"), "");
  EXPECT_NE(errorOfBytes(std::string(bytes.size(), '\xff')), "");
  canopy::LeafMesh mesh = meshWithALook();
  mesh.uv.pop_back();
  EXPECT_NE(errorOfBytes(toBytes(mesh)), "");
  mesh = meshWithALook();
  mesh.rigid.push_back(true);
  EXPECT_NE(errorOfBytes(toBytes(mesh)), "");
}

}  // namespace
}  // namespace vegetation_sim
