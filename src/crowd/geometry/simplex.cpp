// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/geometry/simplex.h"

#include <cmath>

namespace vegetation_sim::crowd::simplex {
namespace {

// An area or volume below this share of its largest possible size is rounding.
constexpr double FLAT = 1e-13;

/// A point of a face of the simplex, and the corners that span the face, as bits.
struct Foot {
  Triple v;
  unsigned corners;
};

Foot nearer(const Foot& a, const Foot& b) {
  return dot(a.v, a.v) <= dot(b.v, b.v) ? a : b;
}

Foot ofSegment(const Simplex& s, int i, int j) {
  const Triple &a = s.at(i), edge = s.at(j) - a;
  const double along = -dot(a, edge), square = dot(edge, edge);
  if (!(along > 0.0)) return {a, 1U << i};
  if (along >= square) return {s.at(j), 1U << j};
  return {a + (along / square) * edge, 1U << i | 1U << j};
}

// The origin is beyond at least one edge, by the signs of the areas that it forms with them.
Foot ofEdges(const Simplex& s, int i, int j, int k, const bool (&beyond)[3]) {
  Foot out{};
  bool any = false;
  const auto offer = [&](int p, int q) {
    const Foot foot = ofSegment(s, p, q);
    out = any ? nearer(out, foot) : foot;
    any = true;
  };
  if (beyond[0]) offer(i, j);
  if (beyond[1]) offer(j, k);
  if (beyond[2]) offer(k, i);
  return out;
}

// The direction is the plane's normal, which is exact for any shape of the triangle.
Foot ofTriangle(const Simplex& s, int i, int j, int k) {
  const Triple &a = s.at(i), &b = s.at(j), &c = s.at(k);
  const Triple ab = b - a, ac = c - a, n = cross(ab, ac);
  const double square = dot(n, n);
  if (!(square > FLAT * FLAT * dot(ab, ab) * dot(ac, ac)))
    return ofEdges(s, i, j, k, {true, true, true});
  const bool beyond[3] = {!(dot(n, cross(a, b)) > 0.0), !(dot(n, cross(b, c)) > 0.0),
                          !(dot(n, cross(c, a)) > 0.0)};
  if (beyond[0] || beyond[1] || beyond[2]) return ofEdges(s, i, j, k, beyond);
  return {(dot(n, a) / square) * n, 1U << i | 1U << j | 1U << k};
}

// Returns whether the origin is beyond the face pqr, seen from the opposite corner.
bool isBeyond(const Triple& p, const Triple& q, const Triple& r, const Triple& opposite,
              bool& flat) {
  const Triple n = cross(q - p, r - p), arm = opposite - p;
  const double inner = dot(n, arm), origin = -dot(n, p);
  flat = flat || inner * inner <= FLAT * FLAT * dot(n, n) * dot(arm, arm);
  return inner > 0.0 ? origin < 0.0 : origin > 0.0;
}

Foot ofTetrahedron(const Simplex& s, bool& inside) {
  constexpr int FACES[4][4] = {{0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}, {0, 1, 2, 3}};
  bool beyond[4], flat = false, any = false;
  for (int i = 0; i < 4; ++i) {
    const int* f = FACES[i];
    beyond[i] = isBeyond(s.at(f[0]), s.at(f[1]), s.at(f[2]), s.at(f[3]), flat);
    any = any || beyond[i];
  }
  inside = !any && !flat;
  Foot out{};
  bool first = true;
  for (int i = 0; i < 4 && !inside; ++i) {
    if (!beyond[i] && !flat) continue;
    const Foot foot = ofTriangle(s, FACES[i][0], FACES[i][1], FACES[i][2]);
    out = first ? foot : nearer(out, foot);
    first = false;
  }
  return out;
}

}  // namespace

Triple nearestToOrigin(Simplex& s, bool& inside) {
  inside = false;
  Foot foot{s.corners[0], 1U};
  switch (s.count) {
    case 1:
      return foot.v;
    case 2:
      foot = ofSegment(s, 1, 0);
      break;
    case 3:
      foot = ofTriangle(s, 2, 1, 0);
      break;
    default:
      foot = ofTetrahedron(s, inside);
      if (inside) return foot.v;
  }
  int kept = 0;
  for (int i = 0; i < s.count; ++i)
    if (foot.corners >> i & 1U) s.corners[static_cast<std::size_t>(kept++)] = s.at(i);
  s.count = kept;
  return foot.v;
}

}  // namespace vegetation_sim::crowd::simplex
