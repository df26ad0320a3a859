// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tree/mesh/bough_levels.h"
#include "vegetation_sim/tree/growth/skeleton.h"

namespace vegetation_sim::forest {

/// A number of a mesh: meshes have single precision.
inline float narrow(double number) {
  return static_cast<float>(number);
}

/// Vertex of bark, fixed to its branch.
struct BarkVertex {
  std::int32_t branch{0};
  std::array<float, 3> local{};   ///< in the branch's frame [m]
  std::array<float, 3> normal{};  ///< in the branch's frame, unit
  std::array<float, 2> uv{};      ///< around (0 to 1), along [m]
};

/// Corners of a leaf card: left and right at its foot, then right and left at its tip.
constexpr int LEAF_CORNERS = 4;
/// Corners in the square of the card's image: along x and along the midrib, in edges, with the foot
/// at (0.5, 0).
using LeafOutline = std::array<std::array<float, 2>, LEAF_CORNERS>;
/// Returns the part of the square that holds the image of a leaf shape's clusters or boughs.
const LeafOutline& leafOutline(LeafShape shape, bool boughs);

/// Fraction of a cluster's square that its leaves cover.
constexpr double LEAF_COVERAGE = 0.4;

/// One leaf cluster: a card fixed to a branch.
struct LeafCard {
  std::int32_t branch{0};
  std::array<float, 3> local{};     ///< foot of the card in the branch's frame [m]
  std::array<float, 4> rotation{};  ///< of the card in the branch's frame, w x y z; y is its midrib
  float size{0.3f};                 ///< edge of the square [m]
  float shade{0.5f};                ///< 0: leaf_colour (inside), 1: leaf_colour_young (outside)
  std::uint32_t key{0};             ///< key of its flutter
};

/// Mesh of one tree at one level of detail: bark tubes, whose rings two successive branches share
/// so that they stay closed when the joint bends (S1-08), and leaf cards.
struct TreeMesh {
  std::vector<BarkVertex> bark;
  std::vector<std::uint32_t>
      triangles;  ///< [3 per triangle] indices into `bark`, seen from outside
  std::vector<LeafCard> leaves;
  std::size_t clusters{0};  ///< number of cards, the first ones, that show a cluster of leaves
  LeafShape shape{};        ///< of the leaves

  /// Returns whether a card shows a whole bough.
  bool showsBough(std::size_t card) const { return card >= clusters; }
  const LeafOutline& outlineOf(std::size_t card) const {
    return leafOutline(shape, showsBough(card));
  }
  /// Two triangles per leaf card.
  std::size_t triangleCount() const { return triangles.size() / 3 + 2 * leaves.size(); }
};

/// Builds the mesh, a pure function of skeleton, species and detail. That of each bough is as in a
/// mesh that has its detail everywhere.
TreeMesh buildMesh(const Skeleton& skeleton, const Species& species, const TreeMeshDetail& detail);
TreeMesh buildMesh(const Skeleton& skeleton, const Species& species, const MeshDetail& detail);

/// Returns the rotation of a leaf card about its midrib and its base [rad] (S1-W5): its mean over
/// time is zero, it grows with the wind speed [m/s] and saturates at `largest`. `seconds` is any
/// clock that replicas share.
std::array<float, 2> leafFlutter(std::uint32_t key, double seconds, double wind_speed,
                                 double largest);

}  // namespace vegetation_sim::forest
