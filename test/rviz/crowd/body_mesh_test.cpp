// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/body_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "crowd/body/walker.h"

namespace vegetation_sim::view {
namespace {

constexpr double HEIGHT = 1.7;  // [m]

grass::GrassMesh meshAt(double pixels, const SharedLight::Shares& light = {},
                        std::uint32_t id = 3) {
  crowd::Walker walker;
  walker.height = HEIGHT;
  grass::GrassMesh out;
  appendBody(
      crowd::skeletonOf(walker, terrain::HeightMap()), crowd::clothesOf(id), bodyStyle(pixels),
      Daylight(), [&](const Vec3&) { return light; }, out);
  return out;
}

Vec3 pointOf(const grass::GrassMesh& mesh, std::size_t vertex) {
  const float* p = &mesh.positions[3 * vertex];
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

double distanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 way = b - a;
  const double square = way.squaredNorm();
  const double part = square > 0.0 ? std::clamp(dot(p - a, way) / square, 0.0, 1.0) : 0.0;
  return length(p - a - part * way);
}

double distanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = cross(b - a, c - a);
  const auto inside = [&](const Vec3& u, const Vec3& v) {
    return dot(cross(v - u, p - u), normal) >= 0.0;
  };
  if (length(normal) > 1e-12 && inside(a, b) && inside(b, c) && inside(c, a))
    return std::fabs(dot(p - a, normal)) / length(normal);
  return std::min(
      {distanceToSegment(p, a, b), distanceToSegment(p, b, c), distanceToSegment(p, c, a)});
}

/// Returns which vertices are corners of triangles that have an area.
std::vector<bool> seenVertices(const grass::GrassMesh& mesh) {
  std::vector<bool> out(mesh.vertexCount(), false);
  for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
    const std::uint32_t* corner = &mesh.indices[k];
    const Vec3 a = pointOf(mesh, corner[0]);
    if (length(cross(pointOf(mesh, corner[1]) - a, pointOf(mesh, corner[2]) - a)) < 1e-6) continue;
    for (int i = 0; i < 3; ++i) out[corner[i]] = true;
  }
  return out;
}

/// Returns the largest distance of the vertices of one mesh from the surface of another [m].
double farthest(const grass::GrassMesh& from, const grass::GrassMesh& to) {
  double out = 0.0;
  const std::vector<bool> seen = seenVertices(from);
  for (std::size_t i = 0; i < from.vertexCount(); ++i) {
    if (!seen[i]) continue;
    double nearest = HEIGHT;
    for (std::size_t k = 0; k + 2 < to.indices.size(); k += 3)
      nearest = std::min(nearest, distanceToTriangle(pointOf(from, i), pointOf(to, to.indices[k]),
                                                     pointOf(to, to.indices[k + 1]),
                                                     pointOf(to, to.indices[k + 2])));
    out = std::max(out, nearest);
  }
  return out;
}

constexpr std::uint32_t TROUSERS = 3, SKIRT = 5, COAT = 8;  // people with these

class PoppingTest : public testing::TestWithParam<std::uint32_t> {};

// When a body is smaller by a thousandth, its surface changes by less than 0.05 pixel, a skirt by
// less than 0.06, and each colour by at most a few of 255.
TEST_P(PoppingTest, NothingPopsAsABodyGetsSmaller) {
  int switches = 0;
  double farthest_pixels = 0.0;
  int colour = 0;
  grass::GrassMesh before = meshAt(400.0, {}, GetParam());
  for (double pixels = 400.0; pixels > 8.0; pixels *= 0.999) {
    const grass::GrassMesh now = meshAt(pixels, {}, GetParam());
    double way = 0.0;
    if (now.vertexCount() == before.vertexCount()) {
      for (std::size_t i = 0; i < now.vertexCount(); ++i)
        way = std::max(way, length(pointOf(now, i) - pointOf(before, i)));
      for (std::size_t i = 0; i < now.colours.size(); ++i)
        colour = std::max(colour, std::abs(int{now.colours[i]} - int{before.colours[i]}));
    } else {
      ++switches;
      way = farthest(before, now);
    }
    farthest_pixels = std::max(farthest_pixels, way * pixels / HEIGHT);
    before = now;
  }
  std::printf("largest step %.4f pixel, %d of 255\n", farthest_pixels, colour);
  EXPECT_EQ(switches, 3);
  EXPECT_LT(farthest_pixels, GetParam() == SKIRT ? 0.06 : 0.05);
  EXPECT_LE(colour, 3);
}
INSTANTIATE_TEST_SUITE_P(Bodies, PoppingTest, testing::Values(TROUSERS, SKIRT, COAT));

// The crown is as high as the person, within 1 %, the soles are on the ground, and fingers reach
// below the wrists.
TEST(BodyMesh, IsAsLargeAsThePerson) {
  crowd::Walker walker;
  walker.height = HEIGHT;
  const crowd::Skeleton skeleton = crowd::skeletonOf(walker, terrain::HeightMap());
  const double wrist = limbOf(skeleton, crowd::Part::FOREARM).to.z();
  const grass::GrassMesh mesh = meshAt(400.0);
  double low = HEIGHT, high = 0.0, hand = HEIGHT;
  for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
    const Vec3 at = pointOf(mesh, i);
    low = std::min(low, at.z());
    high = std::max(high, at.z());
    if (std::fabs(at.y()) > 0.12 * HEIGHT) hand = std::min(hand, at.z());
  }
  EXPECT_NEAR(high, HEIGHT, 0.01 * HEIGHT);
  EXPECT_NEAR(low, 0.0, 0.003);
  EXPECT_LT(hand, wrist - 0.08 * HEIGHT);
  EXPECT_GT(hand, wrist - 0.13 * HEIGHT);
}

double brightness(const grass::GrassMesh& mesh) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.colours.size(); ++i)
    if (i % 4 != 3) sum += mesh.colours[i];
  return sum / (0.75 * static_cast<double>(mesh.colours.size()));
}

TEST(BodyMesh, IsDarkerInTheShade) {
  EXPECT_LT(brightness(meshAt(400.0, {0.0, 1.0})), 0.75 * brightness(meshAt(400.0)));
  EXPECT_LT(brightness(meshAt(400.0, {0.0, 0.5})), 0.7 * brightness(meshAt(400.0, {0.0, 1.0})));
}

TEST(BodyMesh, SmallBodiesCostLess) {
  EXPECT_GT(meshAt(400.0).indices.size(), 10 * meshAt(10.0).indices.size());
  EXPECT_GT(meshAt(10.0).indices.size(), 0u);
}

}  // namespace
}  // namespace vegetation_sim::view
