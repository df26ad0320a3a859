// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/geometry/convex.h"

#include <algorithm>
#include <cmath>

#include "crowd/geometry/simplex.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::crowd {
namespace {

using simplex::nearestToOrigin;
using simplex::Simplex;
using simplex::Triple;

constexpr int MOST_ROUNDS = 64;
constexpr double PRECISION = 1e-14;  ///< relative precision of the bounds
constexpr double TOUCHING = 1e-15;   ///< relative to the size of the simplex

Triple toTriple(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

double clampTo(double x, double half) {
  return std::min(half, std::max(-half, x));
}

// A box in its own frame: its corners, and the vector from it to a place.
struct Brick {
  explicit Brick(const Box& box) : half(toTriple(box.half)) {}
  Triple wayTo(const Triple& p) const {
    return {p.x - clampTo(p.x, half.x), p.y - clampTo(p.y, half.y), p.z - clampTo(p.z, half.z)};
  }
  Triple cornerAlong(const Triple& v) const {
    return {std::copysign(half.x, v.x), std::copysign(half.y, v.y), std::copysign(half.z, v.z)};
  }

  Triple half;
};

Triple inFrame(const Box& box, const Vec3& v) {
  return {dot(box.axes[0], v), dot(box.axes[1], v), dot(box.axes[2], v)};
}

Vec3 toWorld(const Box& box, const Triple& v) {
  return v.x * box.axes[0] + v.y * box.axes[1] + v.z * box.axes[2];
}

// A point minus a box in the frame of the box: the start is the result, one iteration proves it.
struct BoxPointPair {
  BoxPointPair(const Box& a, const Vec3& b) : brick(a), point(inFrame(a, b - a.centre)) {}
  Triple start() const { return brick.wayTo(point); }
  Triple support(const Triple& v) const { return point - brick.cornerAlong(v); }

  Brick brick;
  Triple point;
};

// Second minus first box in the frame of the first.
struct BoxPair {
  BoxPair(const Box& a, const Box& b)
      : brick(a),
        centre(inFrame(a, b.centre - a.centre)),
        axes{inFrame(a, b.axes[0]), inFrame(a, b.axes[1]), inFrame(a, b.axes[2])},
        half{b.half.x(), b.half.y(), b.half.z()} {}
  // Starts with the vector from the first box to the place in the second that is nearest to the
  // first's place nearest to the second's centre. In two thirds of all cases this is the result.
  Triple start() const {
    const Triple way = brick.wayTo(centre);
    Triple place = centre;
    for (std::size_t i = 0; i < 3; ++i)
      place = place - clampTo(dot(way, axes[i]), half[i]) * axes[i];
    const Triple v = brick.wayTo(place);
    return dot(v, v) > 0.0 ? v : centre;
  }
  // Returns the corner that is farthest against v.
  Triple support(const Triple& v) const {
    Triple out = centre - brick.cornerAlong(v);
    for (std::size_t i = 0; i < 3; ++i)
      out = out - std::copysign(half[i], dot(axes[i], v)) * axes[i];
    return out;
  }

  Brick brick;
  Triple centre;
  std::array<Triple, 3> axes;
  std::array<double, 3> half;
};

bool isBall(const Box& box) {
  return box.half.x() == 0.0 && box.half.y() == 0.0 && box.half.z() == 0.0;
}

Triple lowest(const std::vector<Vec3>& points, const Triple& v) {
  Triple out = toTriple(points.front());
  double least = dot(out, v);
  for (const Vec3& point : points) {
    const Triple p = toTriple(point);
    const double height = dot(p, v);
    if (height < least) {
      least = height;
      out = p;
    }
  }
  return out;
}

struct BoxHullPair {
  BoxHullPair(const Box& a, const Hull& b) : box(a), centre(a.centre) {
    points.reserve(b.points.size());
    for (const Vec3& p : b.points) points.push_back(p - centre);
  }
  Triple start() const { return toTriple(points.front()); }
  Triple support(const Triple& v) const {
    Triple out = lowest(points, v);
    for (int i = 0; i < 3; ++i) {
      const Triple axis = toTriple(box.axes[static_cast<std::size_t>(i)]);
      out = out - std::copysign(box.half[i], dot(axis, v)) * axis;
    }
    return out;
  }

  const Box& box;
  Vec3 centre;
  std::vector<Vec3> points;
};

struct HullPair {
  HullPair(const Hull& a, const Hull& b) : origin(a.points.front()) {
    for (const Vec3& p : a.points) first.push_back(p - origin);
    for (const Vec3& p : b.points) second.push_back(p - origin);
  }
  Triple start() const { return toTriple(second.front()); }
  Triple support(const Triple& v) const {
    return lowest(second, v) - lowest(first, Triple{-v.x, -v.y, -v.z});
  }

  Vec3 origin;
  std::vector<Vec3> first, second;
};

struct Cores {
  Triple v{};  ///< from first to second
  double lower{0.0}, upper{0.0};
  bool overlap{false};
  int rounds{0};
};

// The iteration on the difference of two shapes. `v` is a point of it, so its length is an upper
// bound; no point lies below the support w, so v.w / |v| is a lower bound.
template <class Pair>
Cores iterate(const Pair& pair, double enough) {
  Cores out;
  Simplex simplex;
  Triple v = pair.start();
  double square = dot(v, v);
  if (!(square > 0.0)) {
    v = pair.support({1.0, 0.0, 0.0});
    square = dot(v, v);
  }
  out.v = v;
  double best = square, low = 0.0, low_square = 1.0;  // the lower bound is low / sqrt(low_square)
  double largest = 0.0;                               // largest squared corner of the simplex
  for (out.rounds = 1; out.rounds <= MOST_ROUNDS && square > 0.0; ++out.rounds) {
    const Triple w = pair.support(v);
    const double bound = dot(v, w);
    if (bound > 0.0 && bound * bound * low_square > low * low * square) {
      low = bound;
      low_square = square;
    }
    if (square - bound <= PRECISION * square) break;
    if (bound > 0.0 && bound * bound > enough * enough * square) break;
    simplex.add(w);
    largest = std::max(largest, dot(w, w));
    bool inside;
    v = nearestToOrigin(simplex, inside);
    const double before = square;
    square = dot(v, v);
    if (inside || square <= TOUCHING * TOUCHING * largest) square = 0.0;
    if (square < best || out.rounds == 1) {
      best = square;
      out.v = v;
    }
    // Only from the second iteration on each one must come nearer.
    if (out.rounds > 1 && square >= before) break;
  }
  out.upper = std::sqrt(best);
  out.overlap = !(best > 0.0);
  // Mostly the nearest point is also the one that gave the bound.
  const double over = low_square == best ? out.upper : std::sqrt(low_square);
  out.lower = out.overlap ? 0.0 : std::min(low / over, out.upper);
  return out;
}

Separation finish(const Cores& cores, const Vec3& v, double radii) {
  Separation out;
  out.rounds = cores.rounds;
  out.cores_overlap = cores.overlap;
  out.gap = cores.upper - radii;
  out.lower = std::max(0.0, cores.lower - radii);
  out.upper = std::max(0.0, out.gap);
  out.overlapping = !(out.gap > 0.0);
  if (!cores.overlap) out.normal = v / cores.upper;
  return out;
}

}  // namespace

Box ballAt(const Vec3& centre, double radius) {
  Box out;
  out.centre = centre;
  out.radius = radius;
  return out;
}

Box capsuleBetween(const Vec3& base, const Vec3& tip, double radius) {
  Box out;
  out.centre = 0.5 * (base + tip);
  out.radius = radius;
  const Vec3 span = tip - base;
  const double size = length(span);
  if (!(size > 0.0)) return out;
  out.half = Vec3(0.0, 0.0, 0.5 * size);
  const Vec3 z = span / size;
  const Vec3 side = std::fabs(z.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 across = cross(side, z), x = across / length(across);
  out.axes = {{x, cross(z, x), z}};
  return out;
}

Box uprightBox(const Vec3& centre, const Vec3& half, double yaw) {
  const SinCos turn = sinCos(yaw);
  Box out;
  out.centre = centre;
  out.half = half;
  out.axes = {{Vec3(turn.cos, turn.sin, 0.0), Vec3(-turn.sin, turn.cos, 0.0), Vec3::UnitZ()}};
  return out;
}

Separation separation(const Box& a, const Box& b, double enough) {
  const double radii = a.radius + b.radius;
  const auto of_point = [&](const Box& box, const Box& ball, double sign) {
    const Cores cores = iterate(BoxPointPair(box, ball.centre), enough + radii);
    return finish(cores, sign * toWorld(box, cores.v), radii);
  };
  if (isBall(b)) return of_point(a, b, 1.0);
  if (isBall(a)) return of_point(b, a, -1.0);
  const Cores cores = iterate(BoxPair(a, b), enough + radii);
  return finish(cores, toWorld(a, cores.v), radii);
}

Separation separation(const Box& a, const Hull& b, double enough) {
  const double radii = a.radius + b.radius;
  const Cores cores = iterate(BoxHullPair(a, b), enough + radii);
  return finish(cores, Vec3(cores.v.x, cores.v.y, cores.v.z), radii);
}

Separation separation(const Hull& a, const Hull& b, double enough) {
  const double radii = a.radius + b.radius;
  const Cores cores = iterate(HullPair(a, b), enough + radii);
  return finish(cores, Vec3(cores.v.x, cores.v.y, cores.v.z), radii);
}

}  // namespace vegetation_sim::crowd
