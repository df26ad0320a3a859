// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "canopy/plants/mesh_leaves.h"
#include "vegetation_sim/canopy/plants/plant.h"

namespace vegetation_sim {

/// Whether a Collada file is turned as its up axis says, or its axes are kept, as rviz does with
/// the meshes of robots.
enum class MeshAxes { TURNED, KEPT };

/// Returns the path of a file that a mesh names, if it may be opened. @throws InvalidInput if not.
using FindFile = std::function<std::string(const std::string& path)>;

/// The faces of a Collada, OBJ, PLY or STL file, named as resolveFile() takes it, in the unit of
/// length that the file states. @param rigid words in the names of rigid parts, see
/// PlantKind::rigid. @param find finds the materials of an OBJ file, which are read from files of
/// the same folder; null: none is opened. A child process reads the mesh. @throws InvalidInput
/// naming the file, also if that process crashes or takes too much time or memory.
canopy::LeafMesh loadMesh(const std::string& name, MeshAxes axes,
                          const std::string& rigid = canopy::RIGID_WORDS,
                          const FindFile& find = {});

}  // namespace vegetation_sim
