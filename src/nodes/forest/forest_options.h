// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "forest/forest.h"
#include "nodes/base/node_options.h"
#include "nodes/bodies/robot_bodies.h"
#include "nodes/cutters/followed_cutter.h"
#include "nodes/forest/forest_inputs.h"
#include "ros/params/scene_file.h"

namespace vegetation_sim {

/// The forest of a scenario file.
struct ForestScene : SceneBase {
  forest::Layout layout;
  forest::PhysicsSettings physics;
  std::vector<FollowedCutter> cutters;
};
/// No file or no `forest` in it gives no trees. @throws InvalidInput with all faults of the file.
ForestScene loadForestScene(const std::string& name);

/// Parameters of forest_animator; see docs/reference.md.
struct ForestOptions : NodeOptions {
  double key_frame_period{1.0};  ///< [s]
  ForestOptions() {
    markers_rate = 5.0;
    marker_points = 60000;
  }

  double tf_rate{30.0};             ///< [Hz]
  int tf_budget{100};               ///< frames
  std::string frame_prefix;         ///< precedes tree_<id>/branch_<id>
  double branches_rate{10.0};       ///< [Hz]
  std::vector<int> branches_trees;  ///< trees on forest/branches
  int branches_budget{20000};       ///< branches per round of messages
  int cache_budget{400000};         ///< branches of grown trees held in memory
  int threads{1};                   ///< that step physical trees
  double frame_wait{0.0};           ///< for the transforms of bodies at a tick [s]
  double grab_lease{5.0};           ///< of a grab without a lease of its own [s]
  double grab_distance{10.0};       ///< farthest target from the point held [m]
  bool tf_promoted{true};           ///< frames of physical branches, where tf_budget has room
  RobotParts robot;                 ///< bodies that push branches aside
  std::vector<FollowedCutter> cutters;
  ForestTuning tuning;  ///< initial values for dynamic_reconfigure
  ForestScene scene;
};
void describe(FieldVisitor& visitor, ForestOptions& options);

/// Reads and checks all private parameters and the scenario that they name. Parameters override the
/// scenario. @throws InvalidInput with all faults of both.
ForestOptions loadForestOptions(const ros::NodeHandle& private_handle);

}  // namespace vegetation_sim
