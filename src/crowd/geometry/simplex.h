// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace vegetation_sim::crowd::simplex {

/// Three numbers that stay in registers.
struct Triple {
  double x, y, z;
};
inline Triple operator+(const Triple& a, const Triple& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Triple operator-(const Triple& a, const Triple& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Triple operator*(double s, const Triple& a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline double dot(const Triple& a, const Triple& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
inline Triple cross(const Triple& a, const Triple& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Up to four points of the Minkowski difference of two shapes; the newest is the last.
struct Simplex {
  std::array<Triple, 4> corners;
  int count{0};

  const Triple& at(int i) const { return corners[static_cast<std::size_t>(i)]; }
  void add(const Triple& corner) { corners[static_cast<std::size_t>(count++)] = corner; }
};

/// Returns the point of the simplex nearest to the origin and keeps only the corners that span it.
/// A degenerate simplex is replaced by the best of its faces. `inside` is set if it contains the
/// origin.
Triple nearestToOrigin(Simplex& simplex, bool& inside);

}  // namespace vegetation_sim::crowd::simplex
