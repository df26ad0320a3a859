// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "canopy/plants/slice_leaves.h"
#include "vegetation_sim/canopy/canopy_layout.h"

namespace vegetation_sim {

/// Grey pictures, the first of which is named; the others have the numbers after its own.
/// @throws InvalidInput naming the file.
canopy::SliceStack loadSlices(const std::string& name);

/// Reads what kinds of the shapes mesh and slices are made of. Files named without a folder are
/// looked for in `folder`, and named in full then. Adds a fault for each that cannot be read.
void loadForms(canopy::Layout& layout, const std::string& folder, Faults& faults);
/// The same for a layout out of a message, whose files findPublishedFile() finds, with
/// colours, normals and textures of meshes; a texture that cannot be opened is a fault of its
/// material alone. Faults show nothing of the contents of a file.
void loadPublishedForms(canopy::Layout& layout, const std::vector<std::string>& folders,
                        Faults& faults);

}  // namespace vegetation_sim
