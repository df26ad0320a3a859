// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/forest/forest_options.h"

#include <utility>

#include "ros/services/frame_lookup.h"

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

}  // namespace

void describe(FieldVisitor& v, ForestOptions& o) {
  v.integer("state_rate", o.state_rate, "Hz", {1, 240});
  v.number("key_frame_period", o.key_frame_period, "s", {0.05, 60.0});
  v.integer("marker_points", o.marker_points, "", {600, 3000000});
  v.number("tf_rate", o.tf_rate, "Hz", {0.1, 240.0});
  v.integer("tf_budget", o.tf_budget, "frames", {0, 10000});
  v.number("branches_rate", o.branches_rate, "Hz", {0.1, 240.0});
  v.integer("branches_budget", o.branches_budget, "branches", {0, 1000000});
  v.integer("cache_budget", o.cache_budget, "branches", {1000, 20000000});
  v.integer("threads", o.threads, "", {1, 64});
  v.number("frame_wait", o.frame_wait, "s", {0.0, FrameLookup::LONGEST_WAIT});
  v.number("grab_lease", o.grab_lease, "s", {0.1, 3600.0});
  v.number("grab_distance", o.grab_distance, "m", {0.1, 1000.0});
  describe(v, o.tuning);
}

ForestScene loadForestScene(const std::string& name) {
  ForestScene out;
  out.layout.species = {defaultSpecies()};
  if (name.empty()) return out;
  SceneFile file(name, out);
  file.loadTerrain();
  if (file.has("forest")) {
    YamlSection section = file.section("forest");
    out.cutters = readCutters(section);
    out.layout = forest::readLayout(std::move(section), file.folder(), *out.terrain, out.seed,
                                    file.faults());
  }
  if (file.has("physics")) {
    YamlSection physics = file.section("physics");
    describe(physics, out.physics);
    physics.finish();
  }
  file.finish();
  out.layout.terrain = file.terrainName();
  return out;
}

ForestOptions loadForestOptions(const ros::NodeHandle& private_handle) {
  ForestOptions out;
  Parameters parameters(private_handle);
  readScenario(parameters, out, loadForestScene);
  out.tuning.transition = out.scene.layout.motion.transition;
  readFollowedViewer(parameters, out);
  parameters.frame("frame_prefix", out.frame_prefix, true);
  parameters.flag("tf_promoted", out.tf_promoted);
  parameters.integers("branches_trees", out.branches_trees, {0, 1 << 24});
  describe(parameters, out);
  readShard(private_handle, parameters, out);
  out.robot = readRobotParts(private_handle, parameters);
  out.cutters = out.scene.cutters;
  if (YAML::Node list; parameters.list("cutters", list)) {
    YamlSection section(list, private_handle.getNamespace(), parameters.faults());
    out.cutters = readCutters(section);
  }
  if (parameters.faults().empty()) checkTrees(out, parameters);
  parameters.finish();
  return out;
}

}  // namespace vegetation_sim
