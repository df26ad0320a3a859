// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/forest/level_scene.h"
#include "scenes/shipped_scene.h"

namespace vegetation_sim::bench {

constexpr Nanoseconds FRAME_START = scenes::SHIPPED_START;
constexpr int FRAME_RATE = 30;  ///< ticks and pictures per second

using Scene = scenes::ShippedScene;

/// Returns the names of all shipped scenarios.
inline std::vector<std::string> scenarioNames() {
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(scenes::scenarioFolder()))
    if (entry.path().extension() == ".yaml") out.push_back(entry.path().stem());
  std::sort(out.begin(), out.end());
  return out;
}

inline Scene loadScene(const std::string& name) {
  return scenes::loadShippedScene(name);
}

/// Returns a camera 25 m south of the origin at the height of a person, facing north.
inline Viewpoint frameViewpoint(const Scene& scene) {
  Viewpoint out;
  out.position = Vec3(0.0, -25.0, 3.0 + scene.terrain->height(0.0, -25.0));
  out.forward = Vec3::UnitY();
  out.cone_cosine = 0.7;
  out.pixels_per_radian = 0.5 * forest::PICTURE_HEIGHT / std::tan(0.5 * forest::FIELD_OF_VIEW);
  return out;
}

}  // namespace vegetation_sim::bench
