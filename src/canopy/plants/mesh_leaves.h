// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "vegetation_sim/canopy/plants/leaf.h"

namespace vegetation_sim::canopy {

/// Faces of a file, in any unit.
struct LeafMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<double, 2>> uv;  ///< of each vertex; empty if the file has none
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<bool> rigid;              ///< of each face; empty if none is rigid
  std::vector<Vec3> normals;            ///< of each vertex; empty if the file has none
  std::vector<FaceMaterial> materials;  ///< those with a colour or a texture
  std::vector<std::uint16_t> material;  ///< of each face: 1 + index, or 0; empty if all are 0
};

/// Returns whether the name of a material or an object marks rigid faces (S3-02). @param words of
/// PlantKind::rigid.
bool isRigidName(const std::string& name, const std::string& words);

/// Returns the index of the leaf that each face belongs to. Faces that share an edge belong
/// together (S3-03), also if the file duplicates their corners; rigid and other faces never do.
std::vector<std::uint32_t> leavesOf(const LeafMesh& mesh);

/// Scales a mesh to height 1, with its foot at the middle. The root of a leaf is its vertex with
/// the smallest (u, v), or its lowest one. @param y_up y is vertical, else z. @throws InvalidInput
/// with all faults: no faces or too many, missing or infinite corners, no height.
Form formOf(const LeafMesh& mesh, bool y_up);

}  // namespace vegetation_sim::canopy
