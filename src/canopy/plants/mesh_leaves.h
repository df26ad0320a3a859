// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "vegetation_sim/canopy/plants/leaf.h"

namespace vegetation_sim::canopy {

/// Faces as a file has them, in any unit.
struct LeafMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<double, 2>> uv;  ///< of each vertex; empty: the file has none
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<bool> rigid;  ///< of each face; empty: none is
};

/// What a name of a material or an object says of its faces (S3-02): wood, trunk, bark, branch,
/// stem, twig and bough are rigid.
bool isRigidName(const std::string& name);

/// Number of the leaf that each face belongs to: faces that share an edge hang together (S3-03),
/// whether or not the file has their corners twice. Rigid and other faces never do.
std::vector<std::uint32_t> leavesOf(const LeafMesh& mesh);

/// The mesh over its height, on its foot in the middle. The root of a leaf is its vertex with the
/// smallest (u, v), or its lowest one. @param y_up or else z. @throws InvalidInput with all faults:
/// no faces or too many, corners that are not there or not finite, no height.
Form formOf(const LeafMesh& mesh, bool y_up);

}  // namespace vegetation_sim::canopy
