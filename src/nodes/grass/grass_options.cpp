// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/grass_options.h"

#include <algorithm>
#include <cmath>

#include "nodes/cutters/followed_place.h"
#include "ros/services/frame_lookup.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double MOST_COVER_CELLS = 4e6;  // of 20 bytes in grass/cover/values
constexpr int POINTS_PER_BLADE = 27;      // of 9 triangles
constexpr double LEAST_BLADES = 1000.0;   // that a meadow can aim at

// A key that is there is the source's own value, even if it is 0.
TreadLaw readLaw(YamlSection& section) {
  grass::TreadLaw law{0.0, 0.0, 0.0, 0.0, 0.0};
  describe(section, law);
  TreadLaw out = toMsg(law);
  out.has_radius = section.has("radius");
  out.has_reach = section.has("reach");
  out.has_softness = section.has("softness");
  out.has_load = section.has("load");
  out.has_recovery = section.has("recovery");
  return out;
}

FollowedSource readSource(YamlSection& section) {
  FollowedSource out;
  section.text("frame", out.frame);
  section.text("odometry", out.odometry);
  out.name = out.frame.empty() ? out.odometry : out.frame;
  section.text("name", out.name);
  if (out.frame.empty() == out.odometry.empty()) section.fault("needs either frame or odometry");
  readPlace(section, out);
  out.law = readLaw(section);
  section.finish();
  return out;
}

// Values that a source does not give are those of the node.
void checkSources(const GrassOptions& options, Parameters& parameters) {
  for (const FollowedSource& source : options.sources) {
    const std::string context = "source " + inQuotes(source.name) + ": ";
    const grass::TreadLaw law =
        fromMsg(source.law, options.tuning.tread, context, parameters.faults());
    grass::check(law, context, parameters.faults());
  }
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
  v.number("view_range", o.view_range, "m", {0.0, 100000.0});
  v.integer("marker_points", o.marker_points, "", {900, 3000000});
  v.number("frame_wait", o.frame_wait, "s", {0.0, FrameLookup::LONGEST_WAIT});
  v.number("cover_rate", o.cover_rate, "Hz", {0.1, 60.0});
  v.number("cover_resolution", o.cover_resolution, "m", {0.02, 100.0});
  v.number("cover_density", o.cover_scale.density, "1/m^2", {1.0, 20000.0});
  v.number("cover_resistance", o.cover_scale.resistance, "N s/m", {0.001, 1e8});
  v.number("cover_age", o.cover_scale.age, "s", {1.0, 1e9});
  v.choice("cover_layer", o.cover_layer, {"crush", "density", "resistance", "age", "cut"});
  describe(v, o.tuning);
}

GrassScene loadGrassScene(const std::string& name) {
  GrassScene out;
  if (name.empty()) return out;
  SceneFile file(name, out);
  if (file.has("grass")) {
    YamlSection section = file.section("grass");
    out.grass = grass::readScene(section, file.folder(), out.seed, file.faults());
    out.sources = readFollowed(section, "sources", readSource);
    out.cutters = readCutters(section);
    out.colours = grass::readColourMasks(section);
    section.finish();
  } else {
    grass::MapInput bare;
    bare.density.value = 0.0;
    out.grass.layout.map = std::make_shared<const grass::FeatureMap>(bare);
  }
  file.loadTerrain();
  file.finish();
  out.grass.layout.terrain = file.terrainName();
  out.grass.layout.terrain_hash = out.terrain->hash();
  return out;
}

GrassOptions loadGrassOptions(const ros::NodeHandle& private_handle) {
  GrassOptions out;
  Parameters parameters(private_handle);
  readScenario(parameters, out, loadGrassScene);
  out.tuning.tread = out.scene.grass.layout.tread;
  out.sources = out.scene.sources;
  out.cutters = out.scene.cutters;
  readFollowedViewer(parameters, out);
  describe(parameters, out);
  readShard(private_handle, parameters, out);
  YAML::Node list;
  if (parameters.list("sources", list)) {
    YamlSection section(list, private_handle.getNamespace(), parameters.faults());
    out.sources = readFollowed(section, "sources", readSource);
  }
  if (parameters.list("cutters", list)) {
    YamlSection section(list, private_handle.getNamespace(), parameters.faults());
    out.cutters = readCutters(section);
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
