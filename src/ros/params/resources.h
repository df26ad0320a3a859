// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim {

bool isPackageAddress(const std::string& name);

/// Absolute path of a file named as such, as file://PATH, as package://PACKAGE/FILE, or relative to
/// `folder`.
/// @throws InvalidInput for another scheme or a package that is not there.
std::string resolveFile(const std::string& name, const std::string& folder = {});

/// Path of a file that a message names: package://PACKAGE/FILE, or an absolute path in the folder
/// of a package or in one of `folders`. @throws InvalidInput for all others, whether they exist or
/// not.
std::string findPublishedFile(const std::string& address, const std::vector<std::string>& folders);
/// The parameter resource_folders of the node's namespace or of one around it: folders whose files
/// messages may name. Empty if it is not set.
std::vector<std::string> resourceFolders();

/// The terrain of that name; empty: flat. @throws InvalidInput
std::shared_ptr<const terrain::HeightMap> loadTerrain(const std::string& name);
/// The terrain that a message names. @throws InvalidInput that shows nothing of the contents.
std::shared_ptr<const terrain::HeightMap> loadPublishedTerrain(
    const std::string& address, const std::vector<std::string>& folders = resourceFolders());

}  // namespace vegetation_sim
