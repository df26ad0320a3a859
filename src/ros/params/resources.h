// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim {

/// Path of a file named as such, as package://PACKAGE/FILE, or relative to `folder`.
/// @throws InvalidInput for a package that is not there.
std::string resolveFile(const std::string& name, const std::string& folder = {});

/// The terrain of that name; empty: flat. @throws InvalidInput
std::shared_ptr<const terrain::HeightMap> loadTerrain(const std::string& name);

}  // namespace vegetation_sim
