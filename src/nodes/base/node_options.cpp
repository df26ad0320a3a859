// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/base/node_options.h"

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

}  // namespace vegetation_sim
