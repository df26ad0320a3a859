// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "core/config/scenario.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim {

/// The part of a scenario file that every node reads, beside its own section.
struct SceneBase {
  std::string frame_id;  ///< world frame; empty: not given
  std::uint64_t seed{0};
  std::shared_ptr<const terrain::HeightMap> terrain{std::make_shared<terrain::HeightMap>()};
};

/// A scenario file of which the common part has been read. Readers of sections add their faults;
/// finish() throws all of them.
class SceneFile : public Scenario {
 public:
  /// Reads frame_id and seed into `scene`. @param name path or package://PACKAGE/FILE.
  /// @throws InvalidInput if the file is missing or no YAML.
  SceneFile(const std::string& name, SceneBase& scene);

  /// Reads the height map into the scene; one that cannot be read is a fault of the file.
  void loadTerrain();
  /// Name of the height map for other processes: a package and a file, which are valid on other
  /// machines too, or else a path.
  std::string terrainName() const;
  /// Folder from which relative file names count.
  const std::string& folder() const { return folder_; }
  const std::string& path() const { return path_; }

 private:
  std::string path_, folder_, terrain_;
  SceneBase& scene_;
};

}  // namespace vegetation_sim
