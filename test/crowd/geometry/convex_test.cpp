// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/geometry/convex.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/crowd/random_shapes.h"

namespace vegetation_sim::crowd {
namespace {

// Certified gap that the row asks for; sizes are metres, so doubles leave 1e-15 of it to rounding.
constexpr double CERTIFIED = 1e-10;

Vec3 cornerOf(const Box& box, int i) {
  Vec3 out = box.centre;
  for (int k = 0; k < 3; ++k)
    out += ((i >> k & 1) ? 1.0 : -1.0) * box.half[k] * box.axes[static_cast<std::size_t>(k)];
  return out;
}

double fromPoint(const Box& box, const Vec3& point) {
  double square = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double along = dot(box.axes[static_cast<std::size_t>(k)], point - box.centre);
    const double out = std::max(0.0, std::fabs(along) - box.half[k]);
    square += out * out;
  }
  return std::sqrt(square);
}

double betweenSegments(const Vec3& p, const Vec3& d, const Vec3& q, const Vec3& e) {
  // Only where the nearest points are inside both; ends are corners, which fromPoint() has.
  const double a = dot(d, d), b = dot(d, e), c = dot(e, e), det = a * c - b * b;
  if (!(det > 1e-12 * a * c)) return 1e9;
  const Vec3 r = p - q;
  const double s = (b * dot(e, r) - c * dot(d, r)) / det;
  const double t = (a * dot(e, r) - b * dot(d, r)) / det;
  if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0) return 1e9;
  return length(r + s * d - t * e);
}

bool isApartAlong(const Box& a, const Box& b, const Vec3& axis) {
  double reach = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
    reach += a.half[static_cast<int>(k)] * std::fabs(dot(a.axes[k], axis)) +
             b.half[static_cast<int>(k)] * std::fabs(dot(b.axes[k], axis));
  return std::fabs(dot(b.centre - a.centre, axis)) > reach + 1e-13;
}

bool overlap(const Box& a, const Box& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (isApartAlong(a, b, a.axes[i]) || isApartAlong(a, b, b.axes[i])) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 n = cross(a.axes[i], b.axes[k]);
      if (dot(n, n) > 1e-12 && isApartAlong(a, b, n / length(n))) return false;
    }
  }
  return true;
}

// All corners against the other box, and all pairs of edges: every nearest pair is among them.
double enumerated(const Box& a, const Box& b) {
  if (overlap(a, b)) return 0.0;
  double out = 1e9;
  for (int i = 0; i < 8; ++i)
    out = std::min({out, fromPoint(b, cornerOf(a, i)), fromPoint(a, cornerOf(b, i))});
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j) {
      const auto edge = [](const Box& box, int n, Vec3& from, Vec3& along) {
        const int axis = n / 4, u = (axis + 1) % 3, v = (axis + 2) % 3;
        const int corner = (n & 1) << u | (n >> 1 & 1) << v;
        from = cornerOf(box, corner);
        along = cornerOf(box, corner | 1 << axis) - from;
      };
      Vec3 p, d, q, e;
      edge(a, i, p, d);
      edge(b, j, q, e);
      out = std::min(out, betweenSegments(p, d, q, e));
    }
  return out;
}

// S2-31: the distances are those of an enumeration, each with its own proof. The bench asks for
// ten million of them.
TEST(Convex, DistancesAreThoseOfAnEnumeration) {
  int apart = 0;
  for (std::uint64_t i = 0; i < 40000; ++i) {
    const ShapePair pair = randomPair(i);
    const Separation found = separation(pair.a, pair.b);
    const double right = enumerated(pair.a, pair.b);
    // Far from the origin coordinates themselves have a granularity of 2e-13 m.
    ASSERT_NEAR(found.distance(), right, 1e-11) << i;
    ASSERT_LE(found.upper - found.lower, CERTIFIED) << i;
    ASSERT_LE(found.lower, right + 1e-11) << i;
    if (right > 1e-9) {
      ++apart;
      ASSERT_FALSE(found.overlapping) << i;
      ASSERT_NEAR(length(found.normal), 1.0, 1e-12) << i;
    }
  }
  EXPECT_GT(apart, 20000);
}

TEST(Convex, RoundedShapesAreNearerByTheirRadii) {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    ShapePair pair = randomPair(i);
    const double bare = separation(pair.a, pair.b).distance();
    pair.a.radius = 0.1;
    pair.b.radius = 0.2;
    const Separation found = separation(pair.a, pair.b);
    EXPECT_NEAR(found.distance(), std::max(0.0, bare - 0.3), 1e-12);
    EXPECT_EQ(found.overlapping, bare <= 0.3);
    if (bare > 1e-9) {
      EXPECT_NEAR(found.gap, bare - 0.3, 1e-12);
    }
  }
}

TEST(Convex, HullsAreLikeTheBoxesTheySpan) {
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const ShapePair pair = randomPair(i);
    Hull a, b;
    for (int k = 0; k < 8; ++k) {
      a.points.push_back(cornerOf(pair.a, k));
      b.points.push_back(cornerOf(pair.b, k));
    }
    const double right = separation(pair.a, pair.b).distance();
    EXPECT_NEAR(separation(pair.a, b).distance(), right, 1e-11) << i;
    EXPECT_NEAR(separation(a, b).distance(), right, 1e-11) << i;
  }
}

// Points, coincident centres, touching faces: what numerics name as degenerate.
TEST(Convex, DegeneratePairsHaveAnAnswer) {
  const Box point = ballAt(Vec3(1, 2, 3), 0.0);
  EXPECT_TRUE(separation(point, point).overlapping);
  EXPECT_EQ(separation(point, point).distance(), 0.0);
  EXPECT_NEAR(separation(point, ballAt(Vec3(1, 2, 5), 0.5)).distance(), 1.5, 1e-15);

  const Box box = uprightBox(Vec3::Zero(), Vec3(1, 1, 1), 0.0);
  EXPECT_TRUE(separation(box, uprightBox(Vec3(2, 0, 0), Vec3(1, 1, 1), 0.0)).overlapping);
  EXPECT_TRUE(separation(box, uprightBox(Vec3(0, 0, 0), Vec3(0.1, 0.1, 0.1), 0.7)).cores_overlap);
  EXPECT_NEAR(separation(box, uprightBox(Vec3(4, 0, 0), Vec3(1, 1, 0), 0.0)).distance(), 2.0,
              1e-15);
  // A capsule that lies along an edge of the box: every point of both is nearest.
  const Box capsule = capsuleBetween(Vec3(-1, 2, 2), Vec3(1, 2, 2), 0.1);
  EXPECT_NEAR(separation(box, capsule).distance(), std::sqrt(2.0) - 0.1, 1e-14);
}

// A known failure of another library (fcl issue 508): two axis-aligned boxes, 3.16 for 3.
TEST(Convex, AxisAlignedBoxesAreExact) {
  const Box a = uprightBox(Vec3(0, 0, 0), Vec3(0.5, 0.5, 0.5), 0.0);
  const Box b = uprightBox(Vec3(4, 0.5, 1), Vec3(0.5, 1.0, 1.5), 0.0);
  EXPECT_NEAR(separation(a, b).distance(), 3.0, 1e-15);
}

TEST(Convex, StopsWhenItIsFarEnough) {
  const ShapePair pair = randomPair(9);
  const Separation all = separation(pair.a, pair.b), some = separation(pair.a, pair.b, 5.0);
  EXPECT_GT(some.lower, 5.0);
  EXPECT_LE(some.rounds, all.rounds);
  EXPECT_LE(some.lower, all.upper);
  EXPECT_GE(some.upper, all.lower);
}

}  // namespace
}  // namespace vegetation_sim::crowd
