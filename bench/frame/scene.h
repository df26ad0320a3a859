// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/config/scenario.h"
#include "crowd/agents/crowd_scene.h"
#include "package_folder.h"
#include "scenes/forest/level_scene.h"
#include "vegetation_sim/canopy/canopy_layout.h"
#include "vegetation_sim/grass/grass_layout.h"
#include "wind/wind_reader.h"

namespace vegetation_sim::bench {

constexpr Nanoseconds FRAME_START = 1700000000LL * NANOSECONDS_PER_SECOND;
constexpr int FRAME_RATE = 30;  ///< ticks and pictures per second

/// The parts of a shipped scenario that a frame is made of.
struct Scene {
  std::string name;
  std::shared_ptr<const terrain::HeightMap> terrain = std::make_shared<terrain::HeightMap>();
  wind::Field wind;
  std::optional<forest::Layout> forest;
  forest::PhysicsSettings physics;
  std::optional<grass::Scene> grass;
  std::optional<canopy::Layout> canopy;
  std::optional<crowd::Scene> crowd;
};

inline std::string scenarioFolder() {
  return std::string(PACKAGE_FOLDER) + "/config/scenarios";
}

/// Returns the names of all shipped scenarios.
inline std::vector<std::string> scenarioNames() {
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(scenarioFolder()))
    if (entry.path().extension() == ".yaml") out.push_back(entry.path().stem());
  std::sort(out.begin(), out.end());
  return out;
}

inline wind::Field readWindField(Scenario& file, std::uint64_t seed) {
  YamlSection section = file.section("wind");
  std::vector<wind::Primitive> primitives;
  for (const wind::Source& source : wind::readWind(section, seed)) {
    primitives.push_back(wind::startedAt(source, FRAME_START).primitive);
    primitives.back().id = static_cast<std::uint32_t>(primitives.size());
  }
  return wind::Field(primitives, seed);
}

/// @throws InvalidInput
inline Scene loadScene(const std::string& name) {
  const std::string folder = scenarioFolder();
  Scenario file = Scenario::load(folder + "/" + name + ".yaml");
  Scene out;
  out.name = name;
  std::uint64_t seed = 0;
  std::string terrain;
  file.top().seed("seed", seed);
  file.top().text("terrain", terrain);
  if (!terrain.empty())
    out.terrain = std::make_shared<const terrain::HeightMap>(
        terrain::HeightMap::load((std::filesystem::path(folder) / terrain).lexically_normal()));
  if (file.has("forest"))
    out.forest =
        forest::readLayout(file.section("forest"), folder, *out.terrain, seed, file.faults());
  if (file.has("grass")) {
    YamlSection grass = file.section("grass");
    out.grass = grass::readScene(grass, folder, seed, file.faults());
  }
  if (file.has("physics")) {
    YamlSection physics = file.section("physics");
    describe(physics, out.physics);
    physics.finish();
  }
  if (file.has("canopy"))
    out.canopy = canopy::readLayout(file.section("canopy"), *out.terrain, seed, file.faults());
  if (file.has("crowd")) {
    YamlSection crowd = file.section("crowd");
    out.crowd = crowd::readScene(crowd, seed, file.faults());
  }
  out.wind = readWindField(file, seed);
  return out;
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
