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
#include "forest/forest.h"
#include "package_folder.h"
#include "vegetation_sim/canopy/canopy_layout.h"
#include "vegetation_sim/grass/grass_layout.h"
#include "wind/wind_reader.h"

namespace vegetation_sim::scenes {

/// When the wind of shipped scenarios begins.
constexpr Nanoseconds SHIPPED_START = 1700000000LL * NANOSECONDS_PER_SECOND;

/// A scenario of config/scenarios.
struct ShippedScene {
  std::string name;
  std::uint64_t seed{0};
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

inline wind::Field readShippedWind(Scenario& file, std::uint64_t seed) {
  YamlSection section = file.section("wind");
  std::vector<wind::Primitive> primitives;
  for (const wind::Source& source : wind::readWind(section, seed)) {
    primitives.push_back(wind::startedAt(source, SHIPPED_START).primitive);
    primitives.back().id = static_cast<std::uint32_t>(primitives.size());
  }
  return wind::Field(primitives, seed);
}

/// @throws InvalidInput
inline ShippedScene loadShippedScene(const std::string& name) {
  const std::string folder = scenarioFolder();
  Scenario file = Scenario::load(folder + "/" + name + ".yaml");
  ShippedScene out;
  out.name = name;
  std::uint64_t& seed = out.seed;
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
  if (out.forest) out.forest->terrain_hash = out.terrain->hash();
  if (out.grass) out.grass->layout.terrain_hash = out.terrain->hash();
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
  out.wind = readShippedWind(file, seed);
  return out;
}

}  // namespace vegetation_sim::scenes
