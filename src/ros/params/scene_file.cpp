// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/scene_file.h"

#include <filesystem>
#include <utility>

#include "ros/params/resources.h"

namespace vegetation_sim {

SceneFile::SceneFile(const std::string& name, SceneBase& scene)
    : Scenario(load(resolveFile(name))),
      path_(resolveFile(name)),
      folder_(std::filesystem::path(path_).parent_path().string()),
      scene_(scene) {
  top().text("frame_id", scene.frame_id);
  top().seed("seed", scene.seed);
  top().text("terrain", terrain_);
}

void SceneFile::loadTerrain() {
  try {
    scene_.terrain = vegetation_sim::loadTerrain(resolveFile(terrain_, folder_));
  } catch (const InvalidInput& error) {
    faults().add(path_ + ": terrain: " + error.what());
  }
}

std::string SceneFile::terrainName() const {
  return terrain_.find("://") == std::string::npos ? resolveFile(terrain_, folder_) : terrain_;
}

}  // namespace vegetation_sim
