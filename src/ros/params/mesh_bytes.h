// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "canopy/plants/mesh_leaves.h"

namespace vegetation_sim {

constexpr std::size_t MOST_MESH_CORNERS = 16000000;  ///< and as many faces
constexpr std::size_t MOST_MESH_MATERIALS = 1000;    ///< with a colour or a texture
constexpr std::size_t LONGEST_TEXTURE_NAME = 500;    ///< [characters]
/// Bytes of the largest mesh: 64 of a corner, 15 of a face, and those of materials and lengths.
constexpr std::size_t MOST_MESH_BYTES =
    MOST_MESH_CORNERS * (64 + 15) + MOST_MESH_MATERIALS * (64 + LONGEST_TEXTURE_NAME) + 1024;

/// The bytes of a mesh without pictures, for another process of this program. Unlike those of an
/// Archive, numbers need not be finite: readers of meshes reject them where they matter.
std::string toBytes(const canopy::LeafMesh& mesh);
/// @throws InvalidInput for bytes that are not those of a mesh within the limits.
canopy::LeafMesh meshOfBytes(const std::string& bytes);

}  // namespace vegetation_sim
