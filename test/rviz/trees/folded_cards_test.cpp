// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/trees/folded_cards.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegetation_sim::view {
namespace {

using Corners = std::vector<float>;

Vec3 corner(const Corners& at, std::size_t number) {
  return {double{at[3 * number]}, double{at[3 * number + 1]}, double{at[3 * number + 2]}};
}

/// Returns the unit normal of the triangle of three corners.
Vec3 normalOf(const Corners& at, std::size_t a, std::size_t b, std::size_t c) {
  const Vec3 out = cross(Vec3(corner(at, b) - corner(at, a)), Vec3(corner(at, c) - corner(at, a)));
  return out / length(out);
}

// The two triangles of a cluster stand at an angle, so that the eye is never in the plane of both;
// the foot stays on the branch. Boughs are flat.
TEST(FoldedCards, ClustersHaveDepthAndBoughsAreFlat) {
  forest::TreeMesh mesh;
  mesh.leaves.resize(3);
  mesh.clusters = 2;
  for (std::size_t i = 0; i < 3; ++i) {
    mesh.leaves[i].size = 0.5f;
    mesh.leaves[i].key = static_cast<std::uint32_t>(i);
  }
  const Corners card{-0.25f, 0.f, 1.f, 0.25f, 0.f, 1.f, 0.25f, 0.f, 1.5f, -0.25f, 0.f, 1.5f};
  Corners all;
  for (int i = 0; i < 3; ++i) all.insert(all.end(), card.begin(), card.end());
  foldClusters(mesh, all.data());
  for (std::size_t first = 0; first < 8; first += 4) {
    const Vec3 one = normalOf(all, first, first + 1, first + 2);
    const Vec3 other = normalOf(all, first, first + 2, first + 3);
    EXPECT_LT(dot(one, other), std::cos(0.7));
    EXPECT_GT(dot(one, other), std::cos(1.4));
    EXPECT_LT(length(Vec3(0.5 * (corner(all, first) + corner(all, first + 1)) - Vec3(0, 0, 1))),
              1e-6);
  }
  EXPECT_EQ(Corners(all.begin() + 24, all.end()), card);
  mesh.leaves.clear();  // as in a tree without its leaves
  foldClusters(mesh, nullptr);
}

}  // namespace
}  // namespace vegetation_sim::view
