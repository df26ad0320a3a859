// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/contact/mesh_cover.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "forest/contact/contact_body.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

using Points = std::vector<Vec3>;

constexpr int DIRECTIONS = 600;             // in which shapes are compared first
constexpr int REFINED = 4;                  // best of these, around which directions are refined
constexpr std::size_t MOST_FACES = 200000;  // some seconds

/// Directions that cover the sphere evenly: a spiral of equal areas.
const Points& directions() {
  static const Points all = [] {
    Points out;
    for (int i = 0; i < DIRECTIONS; ++i) {
      const double z = 1.0 - (2.0 * i + 1.0) / DIRECTIONS, ring = std::sqrt(1.0 - z * z);
      const SinCos turn = sinCos(2.399963229728653 * i);  // the golden angle
      out.emplace_back(ring * turn.cos, ring * turn.sin, z);
    }
    return out;
  }();
  return all;
}

struct Bounds {
  Vec3 low{Vec3::Constant(std::numeric_limits<double>::max())}, high{-low};
  void add(const Vec3& point) {
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], point[i]);
      high[i] = std::max(high[i], point[i]);
    }
  }
};

double supportOf(const Points& points, const Vec3& side) {
  double out = std::numeric_limits<double>::lowest();
  for (const Vec3& point : points) out = std::max(out, dot(side, point));
  return out;
}

// Points that are farthest in one of the directions: the rest hardly changes the hull, and leaving
// it out can only make an error larger.
Points farthest(const Points& points) {
  if (points.size() <= DIRECTIONS) return points;
  std::vector<std::size_t> found;
  for (const Vec3& side : directions()) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
      if (dot(side, points[i]) > dot(side, points[best])) best = i;
    found.push_back(best);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  Points out;
  for (const std::size_t i : found) out.push_back(points[i]);
  return out;
}

// The largest distance between two convex sets, one in the other, is the largest difference of
// their extents in any direction.
class Excess {
 public:
  Excess(const CoverPart& part, const Points& hull)
      : centre_(part.pose.position), to_part_(conjugate(part.pose.orientation)), hull_(hull) {
    Body body;
    body.shape = part.shape;
    body.size = part.size;
    shape_ = shapeOf(body);
  }

  /// Returns the largest, or any of at least `limit` if there is one.
  double largest(double limit) const {
    std::vector<std::pair<double, Vec3>> found;
    for (const Vec3& side : directions()) {
      found.emplace_back(along(side), side);
      if (found.back().first >= limit) return found.back().first;
    }
    std::partial_sort(found.begin(), found.begin() + REFINED, found.end(),
                      [](const auto& a, const auto& b) { return a.first > b.first; });
    double out = 0.0;
    for (int i = 0; i < REFINED && out < limit; ++i)
      out = std::max(out, refine(found[i].first, found[i].second));
    return out;
  }

 private:
  double along(const Vec3& side) const {
    return dot(side, centre_) + physics::supportOf(shape_, rotate(to_part_, side)) -
           supportOf(hull_, side);
  }
  double refine(double best, Vec3 side) const {
    for (double step = 0.1; step > 1e-4;) {
      const double before = best;
      for (int i = 0; i < 6; ++i) {
        Vec3 next = side;
        next[i / 2] += i % 2 ? step : -step;
        next = next / length(next);
        const double here = along(next);
        if (here > best) best = here, side = next;
      }
      if (!(best > before)) step *= 0.5;
    }
    return best;
  }

  Vec3 centre_;
  Quat to_part_;
  physics::RoundedBox shape_;
  const Points& hull_;
};

// Turns z to an axis.
Quat zTo(int axis) {
  const double half = std::sqrt(0.5);
  if (axis == 0) return {half, 0.0, half, 0.0};
  if (axis == 1) return {half, -half, 0.0, 0.0};
  return {};
}

CoverPart fitBox(const Bounds& bounds) {
  CoverPart out;
  for (int i = 0; i < 3; ++i) out.size[i] = std::max(SMALLEST_BODY, bounds.high[i] - bounds.low[i]);
  out.pose.position = 0.5 * (bounds.low + bounds.high);
  return out;
}

CoverPart fitCapsule(const Points& points, const Bounds& bounds, int axis) {
  CoverPart out;
  out.shape = Shape::CAPSULE;
  const Vec3 centre = 0.5 * (bounds.low + bounds.high);
  const auto fromAxis = [&](Vec3 point) {
    point = point - centre;
    point[axis] = 0.0;
    return length(point);
  };
  double radius = SMALLEST_BODY, half = 0.0;
  for (const Vec3& point : points) radius = std::max(radius, fromAxis(point));
  for (const Vec3& point : points) {
    const double off = fromAxis(point);
    half = std::max(half, std::abs(point[axis] - centre[axis]) -
                              std::sqrt(std::max(0.0, radius * radius - off * off)));
  }
  out.size = Vec3(radius, 0.0, 2.0 * half);
  out.pose = {centre, zTo(axis)};
  return out;
}

// Returns the shape with the least error if that is below the limit, else one that is not.
CoverPart fit(const Points& points, double limit) {
  Bounds bounds;
  for (const Vec3& point : points) bounds.add(point);
  const Points hull = farthest(points);
  CoverPart best = fitBox(bounds);
  best.error = Excess(best, hull).largest(limit);
  for (int axis = 0; axis < 3; ++axis) {
    CoverPart capsule = fitCapsule(points, bounds, axis);
    capsule.error = Excess(capsule, hull).largest(std::min(limit, best.error));
    if (capsule.error < best.error) best = capsule;
  }
  return best;
}

// Adds the points of a triangle between two planes across an axis: its corners there and the
// crossings of its edges with the planes.
void addWithin(const std::array<Vec3, 3>& triangle, int axis, double low, double high,
               Points& out) {
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = triangle[i], &b = triangle[(i + 1) % 3];
    if (a[axis] >= low && a[axis] <= high) out.push_back(a);
    for (const double plane : {low, high})
      if ((a[axis] < plane) != (b[axis] < plane))
        out.push_back(a + (plane - a[axis]) / (b[axis] - a[axis]) * (b - a));
  }
}

// Faces share corners.
void removeDuplicates(Points& points) {
  const auto before = [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

struct Slabs {
  int axis, count;
};

// Returns a shape for each slab. It ends at the first whose error is not below the limit.
std::vector<CoverPart> coverSlabs(const Triangles& surface, const Bounds& bounds, Slabs slabs,
                                  double limit) {
  const auto [axis, count] = slabs;
  std::vector<CoverPart> out;
  const double thickness = (bounds.high[axis] - bounds.low[axis]) / count;
  for (int i = 0; i < count; ++i) {
    const double low = bounds.low[axis] + i * thickness;
    const double high = i + 1 == count ? bounds.high[axis] : low + thickness;
    Points points;
    for (const auto& [a, b, c] : surface.faces)
      addWithin({surface.corners[a], surface.corners[b], surface.corners[c]}, axis, low, high,
                points);
    removeDuplicates(points);
    if (points.empty()) continue;
    out.push_back(fit(points, limit));
    if (!(out.back().error < limit)) break;
  }
  return out;
}

void check(const Triangles& surface) {
  if (surface.faces.empty() || surface.faces.size() > MOST_FACES)
    throw InvalidInput("has " + std::to_string(surface.faces.size()) + " faces, allowed are 1 to " +
                       std::to_string(MOST_FACES));
  for (const auto& face : surface.faces)
    for (const std::uint32_t corner : face) {
      if (corner >= surface.corners.size())
        throw InvalidInput("corner " + std::to_string(corner) +
                           " of a face is unknown; there are " +
                           std::to_string(surface.corners.size()));
      for (const double x :
           {surface.corners[corner].x(), surface.corners[corner].y(), surface.corners[corner].z()})
        if (!(std::abs(x) <= LARGEST_BODY))
          throw InvalidInput("corner " + std::to_string(corner) + " = " + std::to_string(x) +
                             " m is outside -" + std::to_string(LARGEST_BODY) + " to " +
                             std::to_string(LARGEST_BODY) + " m");
    }
}

}  // namespace

double largestError(const std::vector<CoverPart>& parts) {
  double out = 0.0;
  for (const CoverPart& part : parts) out = std::max(out, part.error);
  return out;
}

std::vector<CoverPart> coverTriangles(const Triangles& surface, const CoverSettings& settings) {
  check(surface);
  Bounds bounds;
  for (const auto& face : surface.faces)
    for (const std::uint32_t corner : face) bounds.add(surface.corners[corner]);
  std::vector<CoverPart> best =
      coverSlabs(surface, bounds, {0, 1}, std::numeric_limits<double>::max());
  for (int slabs = 2; slabs <= settings.most_parts && largestError(best) > settings.tolerance;
       slabs *= 2)
    for (int axis = 0; axis < 3; ++axis) {
      const double limit = largestError(best);
      std::vector<CoverPart> parts = coverSlabs(surface, bounds, {axis, slabs}, limit);
      if (largestError(parts) < limit) best = std::move(parts);
    }
  return best;
}

}  // namespace vegetation_sim::forest
