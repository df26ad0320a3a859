// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "crowd/geometry/convex.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::crowd {

/// Pairs that are difficult for a distance algorithm, by the index's last digit: general ones,
/// upright ones, axis-aligned ones with parallel faces and edges, flat ones, segments, points,
/// concentric ones, and ones far away from the origin.
struct ShapePair {
  Box a, b;
};

inline Vec3 randomPoint(const Random& random, std::uint64_t first, double size) {
  const auto at = [&](std::uint64_t i) { return random.uniform(first + i, -size, size); };
  return {at(0), at(1), at(2)};
}

inline void turn(Box& box, const Random& random, std::uint64_t first) {
  Quat q{random.uniform(first, -1.0, 1.0), random.uniform(first + 1, -1.0, 1.0),
         random.uniform(first + 2, -1.0, 1.0), random.uniform(first + 3, -1.0, 1.0)};
  const double size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  q = {q.w / size, q.x / size, q.y / size, q.z / size};
  box.axes = {axisX(q), axisY(q), axisZ(q)};
}

inline Box randomBox(const Random& random, int kind) {
  Box out;
  out.centre = randomPoint(random, 0, 2.0);
  out.half = Vec3(random.uniform(3, 0.05, 1.0), random.uniform(4, 0.05, 1.0),
                  random.uniform(5, 0.05, 1.0));
  const int flat = static_cast<int>(random.uniform(6) * 4.0);  // flat in 0 to 3 directions
  if (kind >= 3 && kind <= 5)
    for (int i = 0; i < flat; ++i) out.half[(i + static_cast<int>(random.bits(7) % 3)) % 3] = 0.0;
  if (kind == 2 || kind == 4) {  // whole tenths put faces and edges on one plane or line
    for (int i = 0; i < 3; ++i) {
      out.centre[i] = 0.25 * std::floor(4.0 * out.centre[i]);
      out.half[i] = 0.25 * std::ceil(4.0 * out.half[i]);
    }
    return out;
  }
  if (kind == 1)
    out = uprightBox(out.centre, out.half, random.uniform(8, -PI, PI));
  else
    turn(out, random, 8);
  return out;
}

inline ShapePair randomPair(std::uint64_t index) {
  const Random random = Random(20).child(index);
  const int kind = static_cast<int>(index % 10);
  ShapePair out{randomBox(random.child(0), kind), randomBox(random.child(1), kind)};
  if (kind == 6) out.b.centre = out.a.centre;
  if (kind == 7) {
    out.a.centre += Vec3(1000.0, -2000.0, 30.0);
    out.b.centre += Vec3(1000.0, -2000.0, 30.0);
  }
  if (kind == 8) out.b.half = Vec3(0.0, 0.0, out.b.half.z());
  if (kind == 9) out.b.centre += Vec3(0.0, 0.0, 30.0);
  return out;
}

}  // namespace vegetation_sim::crowd
