// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "canopy/plants/mesh_leaves.h"
#include "ros/params/mesh_file.h"

namespace vegetation_sim {

/// A mesh file that has been read, and the files that it names.
struct MeshSource {
  std::string ending;  ///< of its name: dae, obj, ply or stl
  std::string bytes;
  std::map<std::string, std::string> materials;  ///< text of each material file, by its name
};

/// Returns the faces of a mesh as loadMesh() does. assimp, which reads them, crashes for some
/// damaged files and does not end for others: to be called in a child process. @throws InvalidInput
canopy::LeafMesh readScene(const MeshSource& source, MeshAxes axes, const std::string& rigid);

}  // namespace vegetation_sim
