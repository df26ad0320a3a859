// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/scenario.h"

#include <filesystem>
#include <vector>

#include "canopy/canopy_layout_reader.h"
#include "package_folder.h"
#include "vegetation_sim/core/config/yaml.h"
#include "wind/wind_reader.h"

namespace vegetation_sim::scenes {
namespace {

const char* const FOLDER = PACKAGE_FOLDER "/scenes";
/// File names in a scene are relative to the folder of the shipped scenarios.
const char* const BASE_FOLDER = PACKAGE_FOLDER "/config/scenarios";

wind::Field readWindField(YamlSection& file, const char* name, std::uint64_t seed) {
  YamlSection section = file.section(name);
  std::vector<wind::Primitive> primitives;
  for (const wind::Source& source : wind::readWind(section, seed)) {
    primitives.push_back(wind::startedAt(source, START).primitive);
    primitives.back().id = static_cast<std::uint32_t>(primitives.size());
  }
  return wind::Field(primitives, seed);
}

template <class Settings>
void readSettings(YamlSection& file, const char* name, Settings& settings) {
  YamlSection section = file.section(name);
  describe(section, settings);
  section.finish();
}

void readPlants(YamlSection& file, Scenario& out, Faults& faults) {
  if (file.has("forest"))
    out.forest =
        forest::readLayout(file.section("forest"), BASE_FOLDER, *out.terrain, out.seed, faults);
  if (file.has("grass")) {
    YamlSection grass = file.section("grass");
    out.grass = grass::readScene(grass, BASE_FOLDER, out.seed, faults);
    grass.finish();
  }
  if (out.forest) out.forest->terrain_hash = out.terrain->hash();
  if (out.grass) out.grass->layout.terrain_hash = out.terrain->hash();
  if (file.has("canopy"))
    out.canopy =
        canopy::readLayout(file.section("canopy"), BASE_FOLDER, *out.terrain, out.seed, faults);
}

}  // namespace

Scenario loadScenario(const std::string& name) {
  Faults faults;
  const std::string path = std::string(FOLDER) + "/" + name + ".yaml";
  YamlSection file(loadYamlFile(path), path, faults);
  Scenario out;
  std::string terrain;
  file.integer("rate", out.rate, "Hz", {1, 1000});
  file.seed("seed", out.seed);
  file.text("terrain", terrain);
  if (!terrain.empty()) terrain = std::string(BASE_FOLDER) + "/" + terrain;
  out.terrain = std::make_shared<const terrain::HeightMap>(terrain::HeightMap::load(terrain));
  readPlants(file, out, faults);
  readSettings(file, "levels", out.levels);
  readSettings(file, "physics", out.physics);
  readSettings(file, "grass_levels", out.grass_levels);
  if (file.has("scan")) readSettings(file, "scan", out.scan.emplace());
  if (file.has("crowd")) {
    YamlSection crowd = file.section("crowd");
    out.crowd = crowd::readScene(crowd, out.seed, faults);
    crowd.finish();
  }
  out.wind = readWindField(file, "wind", out.seed);
  out.later_wind = readWindField(file, "later_wind", out.seed);
  file.finish();
  faults.throwIfAny();
  return out;
}

}  // namespace vegetation_sim::scenes
