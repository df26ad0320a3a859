// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/base/node_options.h"

#include "vegetation_sim/core/config/yaml.h"

namespace vegetation_sim {

void readCommon(Parameters& parameters, NodeOptions& options) {
  parameters.frame("frame_id", options.frame_id);
  parameters.flag("replay", options.replay);
  parameters.number("replay_delay", options.replay_delay, "s", {0.0, 10.0});
  parameters.number("markers_rate", options.markers_rate, "Hz", {0.1, 60.0});
  readSnapshotOptions(parameters, options.snapshots);
}

void readFollowedViewer(Parameters& parameters, NodeOptions& options) {
  parameters.frame("viewer_frame", options.viewer_frame, true);
  parameters.number("viewer_field_of_view", options.viewer_field_of_view, "rad", {0.01, 3.1});
  parameters.integer("viewer_height", options.viewer_height, "pixel", {1, 100000});
}

void readShard(const ros::NodeHandle& private_handle, Parameters& parameters,
               NodeOptions& options) {
  YAML::Node map;
  if (!parameters.map("shard", map)) return;
  YamlSection section(map, private_handle.resolveName("shard"), parameters.faults());
  int index = 0, count = 1;
  section.integer("index", index, "", {0, MOST_SHARDS - 1.0});
  section.integer("count", count, "", {1, static_cast<double>(MOST_SHARDS)});
  section.number("wait", options.shard_wait, "s", {0.1, 600.0});
  section.finish();
  if (!parameters.faults().empty()) return;
  options.shard = Shard{static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(count)};
  check(*options.shard, parameters.faults());
  if (count > 1 && options.replay)
    parameters.fault("replay", "= true is not allowed with shard/count = " + std::to_string(count) +
                                   ", only with 1");
}

}  // namespace vegetation_sim
