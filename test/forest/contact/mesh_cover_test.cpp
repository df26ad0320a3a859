// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/contact/mesh_cover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error_text.h"
#include "forest/contact/contact_body.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::forest {
namespace {

// A prism over a convex outline in the plane of x and y, from z = 0 to the height.
Triangles prism(const std::vector<Vec3>& outline, double height) {
  Triangles out;
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (const double z : {0.0, height})
    for (const Vec3& corner : outline) out.corners.push_back(corner + z * Vec3::UnitZ());
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    out.faces.push_back({i, j, n + j});
    out.faces.push_back({i, n + j, n + i});
    if (i > 0 && j > 0) out.faces.push_back({0, i, j}), out.faces.push_back({n, n + i, n + j});
  }
  return out;
}

Triangles block(const Vec3& low, const Vec3& high) {
  Triangles out = prism({Vec3(low.x(), low.y(), low.z()), Vec3(high.x(), low.y(), low.z()),
                         Vec3(high.x(), high.y(), low.z()), Vec3(low.x(), high.y(), low.z())},
                        high.z() - low.z());
  return out;
}

Triangles tube(double radius, double height) {
  std::vector<Vec3> outline;
  for (int i = 0; i < 48; ++i) {
    const SinCos turn = sinCos(2.0 * PI * i / 48);
    outline.emplace_back(radius * turn.cos, radius * turn.sin, 0.0);
  }
  return prism(outline, height);
}

Triangles both(Triangles a, const Triangles& b) {
  const auto first = static_cast<std::uint32_t>(a.corners.size());
  a.corners.insert(a.corners.end(), b.corners.begin(), b.corners.end());
  for (const auto& face : b.faces)
    a.faces.push_back({first + face[0], first + face[1], first + face[2]});
  return a;
}

double distanceTo(const CoverPart& part, const Vec3& point) {
  Body body;
  body.shape = part.shape;
  body.size = part.size;
  Vec3 normal;
  return signedDistance(shapeOf(body),
                        rotate(conjugate(part.pose.orientation), Vec3(point - part.pose.position)),
                        normal);
}

// Largest distance of a random point of the surface from the nearest part.
double uncovered(const Triangles& surface, const std::vector<CoverPart>& parts) {
  const Random random(7);
  double out = 0.0;
  std::uint64_t draw = 0;
  for (const auto& face : surface.faces)
    for (int i = 0; i < 200; ++i) {
      double u = random.uniform(draw++), v = random.uniform(draw++);
      if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      const Vec3 &a = surface.corners[face[0]], &b = surface.corners[face[1]],
                 &c = surface.corners[face[2]];
      double nearest = std::numeric_limits<double>::max();
      for (const CoverPart& part : parts)
        nearest = std::min(nearest, distanceTo(part, a + u * (b - a) + v * (c - a)));
      out = std::max(out, nearest);
    }
  return out;
}

TEST(MeshCover, BlockIsOneBox) {
  const auto parts = coverTriangles(block(Vec3(-0.2, 0.0, 0.1), Vec3(0.3, 0.4, 0.2)), {});
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].shape, Shape::BOX);
  EXPECT_NEAR(length(parts[0].size - Vec3(0.5, 0.4, 0.1)), 0.0, 1e-12);
  EXPECT_NEAR(length(parts[0].pose.position - Vec3(0.05, 0.2, 0.15)), 0.0, 1e-12);
  EXPECT_NEAR(parts[0].error, 0.0, 1e-12);
}

// The corners of a square are (sqrt(2) - 1) r away from the circle in it.
TEST(MeshCover, ErrorOfABoxAroundATubeIsThatOfItsCorners) {
  const auto parts = coverTriangles(tube(0.05, 0.6), {0.05, 8});
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].shape, Shape::BOX);
  EXPECT_NEAR(parts[0].error, 0.05 * (std::sqrt(2.0) - 1.0), 1e-6);
}

TEST(MeshCover, PartsContainTheSurface) {
  for (const Triangles& surface :
       {tube(0.3, 0.2), tube(0.05, 0.7),
        both(block(Vec3::Zero(), Vec3(1.0, 0.2, 0.2)), block(Vec3::Zero(), Vec3(0.2, 0.2, 1.0)))})
    EXPECT_LT(uncovered(surface, coverTriangles(surface, {0.01, 8})), 1e-9);
}

TEST(MeshCover, MorePartsFollowTheSurfaceMoreClosely) {
  const Triangles corner =
      both(block(Vec3::Zero(), Vec3(1.0, 0.2, 0.2)), block(Vec3::Zero(), Vec3(0.2, 0.2, 1.0)));
  const double one = largestError(coverTriangles(corner, {1e-3, 1}));
  const double eight = largestError(coverTriangles(corner, {1e-3, 8}));
  EXPECT_GT(one, 0.5);
  EXPECT_LT(eight, 0.1);
  EXPECT_LE(coverTriangles(corner, {1e-3, 8}).size(), 8u);
  EXPECT_EQ(coverTriangles(corner, {1.0, 8}).size(), 1u);
}

// The middles of its faces are inside the ball by r (1 - cos 5.3 degrees) = 0.86 mm. The stated
// error may be larger, since it uses the points that are farthest in one of 600 directions, which
// are up to 0.15 rad apart: r (1 - cos 0.15) = 2.2 mm.
TEST(MeshCover, BallIsACapsuleWithoutLength) {
  Triangles ball;
  const int rows = 24, columns = 48;
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const SinCos polar = sinCos(PI * i / rows), turn = sinCos(2.0 * PI * j / columns);
      ball.corners.emplace_back(0.2 * polar.sin * turn.cos, 0.2 * polar.sin * turn.sin,
                                0.2 * polar.cos);
    }
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const auto a = static_cast<std::uint32_t>(i * columns + j),
                 b = static_cast<std::uint32_t>(i * columns + (j + 1) % columns);
      ball.faces.push_back({a, b, b + columns});
      ball.faces.push_back({a, b + columns, a + columns});
    }
  const auto parts = coverTriangles(ball, {});
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].shape, Shape::CAPSULE);
  EXPECT_NEAR(parts[0].size.x(), 0.2, 1e-9);
  EXPECT_LT(parts[0].size.z(), 1e-6);
  EXPECT_GT(parts[0].error, 0.8e-3);
  EXPECT_LT(parts[0].error, 2.2e-3);
}

TEST(MeshCover, FlatSurfaceHasTheLeastThickness) {
  const auto parts =
      coverTriangles({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}, {});
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].size, Vec3(1.0, 1.0, SMALLEST_BODY));
}

TEST(MeshCover, BadSurfacesAreRejected) {
  EXPECT_EQ(errorOf([] { coverTriangles({}, {}); }), "has 0 faces, allowed are 1 to 200000");
  EXPECT_EQ(errorOf([] {
              coverTriangles({{{0, 0, 0}}, {{0, 0, 1}}}, {});
            }),
            "corner 1 of a face is unknown; there are 1");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(errorOf([&] {
              coverTriangles({{{0, nan, 0}}, {{0, 0, 0}}}, {});
            }),
            "corner 0 = nan m is outside -50.000000 to 50.000000 m");
  EXPECT_EQ(errorOf([] {
              coverTriangles({{{0, 0, 51}}, {{0, 0, 0}}}, {});
            }),
            "corner 0 = 51.000000 m is outside -50.000000 to 50.000000 m");
}

}  // namespace
}  // namespace vegetation_sim::forest
