// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/forest/forest_options.h"

#include <filesystem>

#include "core/config/scenario.h"
#include "ros/params/parameters.h"
#include "ros/params/resources.h"

namespace vegetation_sim {
namespace {

forest::Species defaultSpecies() {
  forest::Species out;
  out.name = "tree";
  return out;
}

void checkTrees(const ForestOptions& options, Parameters& parameters) {
  const std::uint32_t count = options.scene.layout.treeCount();
  for (const int tree : options.branches_trees)
    if (static_cast<std::uint32_t>(tree) >= count)
      parameters.fault("branches_trees", "= " + std::to_string(tree) + " is unknown; there are " +
                                             std::to_string(count) + " trees, from 0");
}

// Parameters override the scenario.
void readScene(ForestOptions& options, Faults& faults) {
  ForestScene& scene = options.scene;
  try {
    scene = loadForestScene(options.scenario);
    if (!scene.frame_id.empty()) options.frame_id = scene.frame_id;
    options.tuning.transition = scene.layout.motion.transition;
  } catch (const InvalidInput& error) {
    faults.add(error.what());
  }
}

}  // namespace

void describe(FieldVisitor& v, ForestOptions& o) {
  v.integer("state_rate", o.state_rate, "Hz", {1, 240});
  v.number("key_frame_period", o.key_frame_period, "s", {0.05, 60.0});
  v.number("markers_rate", o.markers_rate, "Hz", {0.1, 60.0});
  v.integer("marker_points", o.marker_points, "", {600, 3000000});
  v.number("tf_rate", o.tf_rate, "Hz", {0.1, 240.0});
  v.integer("tf_budget", o.tf_budget, "frames", {0, 10000});
  v.number("branches_rate", o.branches_rate, "Hz", {0.1, 240.0});
  v.integer("branches_budget", o.branches_budget, "branches", {0, 1000000});
  v.integer("cache_budget", o.cache_budget, "branches", {1000, 20000000});
  v.integer("threads", o.threads, "", {1, 64});
  v.number("viewer_field_of_view", o.viewer_field_of_view, "rad", {0.01, 3.1});
  v.integer("viewer_height", o.viewer_height, "pixel", {1, 100000});
  v.number("grab_lease", o.grab_lease, "s", {0.1, 3600.0});
  v.number("grab_distance", o.grab_distance, "m", {0.1, 1000.0});
  v.number("replay_delay", o.replay_delay, "s", {0.0, 10.0});
  describe(v, o.tuning);
}

ForestScene loadForestScene(const std::string& file) {
  ForestScene out;
  if (file.empty()) {
    out.layout.species = {defaultSpecies()};
    return out;
  }
  const std::string path = resolveFile(file);
  Scenario scenario = Scenario::load(path);
  const std::string folder = std::filesystem::path(path).parent_path().string();
  std::uint64_t seed = 0;
  std::string terrain;
  scenario.top().text("frame_id", out.frame_id);
  scenario.top().seed("seed", seed);
  scenario.top().text("terrain", terrain);
  if (scenario.has("forest"))
    out.layout = forest::readLayout(scenario.section("forest"), folder, seed, scenario.faults());
  else
    out.layout.species = {defaultSpecies()};
  if (scenario.has("physics")) {
    YamlSection physics = scenario.section("physics");
    describe(physics, out.physics);
    physics.finish();
  }
  try {
    out.layout.terrain = resolveFile(terrain, folder);
    out.terrain = loadTerrain(out.layout.terrain);
  } catch (const InvalidInput& error) {
    scenario.faults().add(path + ": terrain: " + error.what());
  }
  scenario.finish();
  // The name of a package is valid on other machines too, a path is not.
  if (terrain.find("://") != std::string::npos) out.layout.terrain = terrain;
  return out;
}

ForestOptions loadForestOptions(const ros::NodeHandle& private_handle) {
  ForestOptions out;
  Parameters parameters(private_handle);
  parameters.text("scenario", out.scenario);
  readScene(out, parameters.faults());
  parameters.frame("frame_id", out.frame_id);
  parameters.frame("viewer_frame", out.viewer_frame, true);
  parameters.flag("tf_promoted", out.tf_promoted);
  parameters.flag("replay", out.replay);
  parameters.integers("branches_trees", out.branches_trees, {0, 1 << 24});
  describe(parameters, out);
  out.robot = readRobotParts(private_handle, parameters);
  if (parameters.faults().empty()) checkTrees(out, parameters);
  parameters.finish();
  return out;
}

}  // namespace vegetation_sim
