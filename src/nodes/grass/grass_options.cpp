// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/grass_options.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "core/config/scenario.h"
#include "ros/params/parameters.h"
#include "ros/params/resources.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double MOST_COVER_CELLS = 16e6;
constexpr int POINTS_PER_BLADE = 27;     // of 9 triangles
constexpr double LEAST_BLADES = 1000.0;  // that a meadow can aim at

FollowedSource readSource(YamlSection& section) {
  FollowedSource out;
  section.text("frame", out.frame);
  section.text("odometry", out.odometry);
  out.name = out.frame.empty() ? out.odometry : out.frame;
  section.text("name", out.name);
  if (out.frame.empty() == out.odometry.empty()) section.fault("needs either frame or odometry");
  if (!out.frame.empty() && out.frame[0] == '/')
    section.fault("frame", "= '" + out.frame + "' begins with '/'");
  section.vector("offset", out.offset, "m", {-100.0, 100.0});
  section.number("height_gate", out.height_gate, "m", {0.0, 1000.0});
  out.law = {0.0, 0.0, 0.0, 0.0, 0.0};  // the node's
  describe(section, out.law);
  section.finish();
  return out;
}

std::vector<FollowedSource> readSources(YamlSection& section) {
  std::vector<FollowedSource> out;
  std::set<std::string> names;
  for (YamlSection& entry : section.sections("sources")) {
    out.push_back(readSource(entry));
    if (!names.insert(out.back().name).second)
      section.fault("sources", "names '" + out.back().name + "' twice");
  }
  if (out.size() > MOST_FOLLOWED_SOURCES)
    section.fault("sources", "are " + std::to_string(out.size()) + ", allowed are " +
                                 std::to_string(MOST_FOLLOWED_SOURCES));
  return out;
}

// Parameters override the scenario.
void readScene(GrassOptions& options, Faults& faults) {
  GrassScene& scene = options.scene;
  try {
    scene = loadGrassScene(options.scenario);
    if (!scene.frame_id.empty()) options.frame_id = scene.frame_id;
    options.tuning.tread = scene.grass.layout.tread;
    options.sources = scene.sources;
  } catch (const InvalidInput& error) {
    faults.add(error.what());
  }
}

// Zeros of a source stand for the tuning of the node.
void checkSources(const GrassOptions& options, Parameters& parameters) {
  for (const FollowedSource& source : options.sources)
    grass::check(fromMsg(toMsg(source.law), options.tuning.tread),
                 "source '" + source.name + "': ", parameters.faults());
}

void checkCover(const GrassOptions& options, Parameters& parameters) {
  const grass::MapLaw& law = options.scene.grass.layout.map->law();
  const double size = law.resolution / options.cover_resolution;
  const double cells = std::ceil(size * (law.columns - 1)) * std::ceil(size * (law.rows - 1));
  if (cells > MOST_COVER_CELLS)
    parameters.fault("cover_resolution", "= " + std::to_string(options.cover_resolution) +
                                             " m makes " + std::to_string(cells) +
                                             " cells, allowed are " +
                                             std::to_string(MOST_COVER_CELLS));
}

}  // namespace

void describe(FieldVisitor& v, GrassTuning& t) {
  v.number("drag", t.drag, "N s/m", {0.0, 1000.0});
  v.number("height_gate", t.height_gate, "m", {0.0, 1000.0});
  v.number("tread_radius", t.tread.radius, "m", {0.005, 5.0});
  v.number("tread_reach", t.tread.reach, "m", {0.01, 10.0});
  v.number("tread_softness", t.tread.softness, "m", {0.001, 5.0});
  v.number("tread_load", t.tread.load, "", {0.0, 10.0});
  v.number("tread_recovery", t.tread.recovery, "s", {0.0, grass::PERMANENT_RECOVERY});
  v.number("tolerance", t.view.tolerance, "pixel", {0.1, 100.0});
  v.number("transition", t.view.transition, "s", {0.0, 60.0});
  v.number("farthest", t.view.farthest, "m", {1.0, 1e4});
}

void check(GrassTuning tuning) {
  Faults faults;
  FieldChecker checker("", faults);
  describe(checker, tuning);
  if (faults.empty()) grass::check(tuning.tread, "tread_", faults);
  faults.throwIfAny();
}

GrassTuning fromConfig(const GrassFieldConfig& config, const grass::MeadowSettings& view) {
  GrassTuning out;
  out.drag = config.drag;
  out.height_gate = config.height_gate;
  out.tread = {config.tread_radius, config.tread_reach, config.tread_softness, config.tread_load,
               config.tread_recovery};
  out.view = {config.tolerance, config.transition, config.farthest, view.most_blades};
  return out;
}

void toConfig(const GrassTuning& tuning, GrassFieldConfig& config) {
  config.drag = tuning.drag;
  config.height_gate = tuning.height_gate;
  config.tread_radius = tuning.tread.radius;
  config.tread_reach = tuning.tread.reach;
  config.tread_softness = tuning.tread.softness;
  config.tread_load = tuning.tread.load;
  config.tread_recovery = tuning.tread.recovery;
  config.tolerance = tuning.view.tolerance;
  config.transition = tuning.view.transition;
  config.farthest = tuning.view.farthest;
}

void describe(FieldVisitor& v, GrassOptions& o) {
  v.integer("state_rate", o.state_rate, "Hz", {1, 240});
  v.number("key_frame_period", o.key_frame_period, "s", {0.05, 60.0});
  v.integer("state_bytes", o.state_bytes, "B/s", {1000, 1000000000});
  v.number("markers_rate", o.markers_rate, "Hz", {0.1, 60.0});
  v.integer("marker_points", o.marker_points, "", {900, 3000000});
  v.number("cover_rate", o.cover_rate, "Hz", {0.1, 60.0});
  v.number("cover_resolution", o.cover_resolution, "m", {0.02, 100.0});
  v.number("cover_age", o.cover_age, "s", {1.0, 1e9});
  v.choice("cover_layer", o.cover_layer, {"crush", "density", "resistance", "age"});
  v.number("viewer_field_of_view", o.viewer_field_of_view, "rad", {0.01, 3.1});
  v.integer("viewer_height", o.viewer_height, "pixel", {1, 100000});
  v.number("replay_delay", o.replay_delay, "s", {0.0, 10.0});
  describe(v, o.tuning);
}

GrassScene loadGrassScene(const std::string& file) {
  GrassScene out;
  if (file.empty()) return out;
  const std::string path = resolveFile(file);
  Scenario scenario = Scenario::load(path);
  const std::string folder = std::filesystem::path(path).parent_path().string();
  std::uint64_t seed = 0;
  std::string terrain;
  scenario.top().text("frame_id", out.frame_id);
  scenario.top().seed("seed", seed);
  scenario.top().text("terrain", terrain);
  if (scenario.has("grass")) {
    YamlSection section = scenario.section("grass");
    out.grass = grass::readScene(section, folder, seed, scenario.faults());
    out.sources = readSources(section);
    section.finish();
  } else {
    grass::MapInput bare;
    bare.density.value = 0.0;
    out.grass.layout.map = std::make_shared<const grass::FeatureMap>(bare);
  }
  try {
    out.grass.layout.terrain = resolveFile(terrain, folder);
    out.terrain = loadTerrain(out.grass.layout.terrain);
    out.grass.layout.terrain_hash = out.terrain->hash();
  } catch (const InvalidInput& error) {
    scenario.faults().add(path + ": terrain: " + error.what());
  }
  scenario.finish();
  // The name of a package is valid on other machines too, a path is not.
  if (terrain.find("://") != std::string::npos) out.grass.layout.terrain = terrain;
  return out;
}

GrassOptions loadGrassOptions(const ros::NodeHandle& private_handle) {
  GrassOptions out;
  Parameters parameters(private_handle);
  parameters.text("scenario", out.scenario);
  readScene(out, parameters.faults());
  parameters.frame("frame_id", out.frame_id);
  parameters.frame("viewer_frame", out.viewer_frame, true);
  parameters.flag("replay", out.replay);
  describe(parameters, out);
  YAML::Node list;
  if (parameters.list("sources", list)) {
    YamlSection section(list, private_handle.getNamespace(), parameters.faults());
    out.sources = readSources(section);
  }
  if (parameters.faults().empty()) checkCover(out, parameters);
  if (parameters.faults().empty()) grass::check(out.tuning.tread, "tread_", parameters.faults());
  if (parameters.faults().empty()) checkSources(out, parameters);
  parameters.finish();
  out.scene.grass.layout.tread = out.tuning.tread;
  out.tuning.view.most_blades =
      std::max(LEAST_BLADES, out.marker_points / (3.0 * POINTS_PER_BLADE));
  return out;
}

}  // namespace vegetation_sim
