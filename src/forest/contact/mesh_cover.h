// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tree/physical/interaction.h"

namespace vegetation_sim::forest {

/// Triangles of a surface; they need not be closed.
struct Triangles {
  std::vector<Vec3> corners;                        ///< [m]
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< indices of corners
};

/// A box or capsule that contains a part of a surface.
struct CoverPart {
  Shape shape{Shape::BOX};
  Vec3 size{Vec3::Zero()};  ///< as Body::size [m]
  Pose pose;                ///< in the axes of the surface
  /// Largest distance from a point of the shape to the convex hull of what it contains [m].
  double error{0.0};
};

/// How closely shapes follow a surface.
struct CoverSettings {
  double tolerance{0.02};  ///< error at which no more parts are tried [m]
  int most_parts{8};
};

/// Covers a surface with shapes that branches can touch. It is cut into 1, 2, 4 ... slabs across
/// the axis with the least error, and each slab gets a box or a capsule along one of its axes. The
/// shapes contain all triangles, and the largest of their errors is the result's, which is the
/// least that was found with at most `most_parts`. Edges and radii are at least SMALLEST_BODY.
/// @throws InvalidInput for no faces, more than 200 000, unknown corners and corners beyond
/// LARGEST_BODY.
std::vector<CoverPart> coverTriangles(const Triangles& surface, const CoverSettings& settings);

/// Returns the largest error of the parts [m].
double largestError(const std::vector<CoverPart>& parts);

}  // namespace vegetation_sim::forest
