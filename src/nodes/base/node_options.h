// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "core/shards/shard_split.h"
#include "nodes/snapshots/snapshot_folder.h"
#include "ros/params/parameters.h"

namespace vegetation_sim {

/// Parameters that every node of a simulation on the tick grid has.
struct NodeOptions {
  std::string scenario;              ///< file; empty: the node's default scene
  std::string frame_id{"map"};       ///< world frame
  int state_rate{30};                ///< ticks [Hz]
  double markers_rate{10.0};         ///< [Hz]
  int marker_points{90000};          ///< budget of all marker lists together
  bool replay{false};                ///< applies recorded events instead of live inputs
  double replay_delay{0.5};          ///< how far ticks stay behind the clock in a replay [s]
  std::string viewer_id;             ///< viewer that the node follows; empty: any
  std::string viewer_frame;          ///< tf frame (x forward) used as a viewer; empty: none
  double viewer_field_of_view{0.8};  ///< [rad]
  int viewer_height{900};            ///< [pixel]
  SnapshotOptions snapshots;
  std::optional<Shard> shard;  ///< share of the landscape that the node animates; none: all
  double shard_wait{5.0};      ///< for the answer of another shard, wall time [s]
};

/// Reads the parameters that have the same name and range in every node.
void readCommon(Parameters& parameters, NodeOptions& options);
/// Reads the viewer that follows a tf frame, of a node whose viewers see pixels.
void readFollowedViewer(Parameters& parameters, NodeOptions& options);
/// Reads the shard of the node, and the time that it waits for others, of a map.
void readShard(const ros::NodeHandle& private_handle, Parameters& parameters, NodeOptions& options);

/// Reads a node's scenario and common parameters; parameters override the scenario. Faults of the
/// scenario are added to those of the parameters. @tparam Options derived from NodeOptions, with a
/// member `scene` derived from SceneBase. @param load returns the scene of a file; an empty name
/// stands for the node's default scene.
template <class Options, class Load>
void readScenario(Parameters& parameters, Options& options, Load load) {
  parameters.text("scenario", options.scenario);
  try {
    options.scene = load(options.scenario);
    if (!options.scene.frame_id.empty()) options.frame_id = options.scene.frame_id;
  } catch (const InvalidInput& error) {
    parameters.faults().add(error.what());
  }
  readCommon(parameters, options);
}

}  // namespace vegetation_sim
