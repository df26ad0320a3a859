// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <vegetation_sim/CanopyAnimatorConfig.h>

#include <string>

#include "nodes/base/node_options.h"
#include "nodes/bodies/robot_bodies.h"
#include "nodes/cutters/followed_cutter.h"
#include "ros/params/scene_file.h"
#include "vegetation_sim/canopy/canopy_layout.h"

namespace vegetation_sim {

/// The part of canopy::Motion that can be reconfigured while canopy_animator runs (S3-29).
struct CanopyTuning {
  canopy::SourceSettings sources;
  canopy::OscillatorSettings oscillator;
  canopy::LayerSettings layers;
  canopy::CutSettings cuts;
  canopy::WarpSettings warp;
};
void describe(FieldVisitor& visitor, CanopyTuning& tuning);
CanopyTuning tuningOf(const canopy::Motion& motion);
/// `motion` with the described fields of the tuning.
canopy::Motion withTuning(canopy::Motion motion, const CanopyTuning& tuning);
CanopyTuning fromConfig(const CanopyAnimatorConfig& config);
/// Writes the tuning into what dynamic_reconfigure shows.
void toConfig(const CanopyTuning& tuning, CanopyAnimatorConfig& config);

/// The plants of a scenario file.
struct CanopyScene : SceneBase {
  canopy::Layout layout;
  std::vector<FollowedCutter> cutters;
};
/// No file or no `canopy` in it gives no plants. @throws InvalidInput with all faults of the file.
CanopyScene loadCanopyScene(const std::string& name);

/// Parameters of canopy_animator; see docs/reference.md.
struct CanopyOptions : NodeOptions {
  double tolerance{1.0};         ///< error of what is drawn, at 1000 pixels a radian [pixel]
  double cover_resolution{0.5};  ///< edge of a cell of canopy/cover/cut [m]
  double frame_wait{0.0};        ///< for the transforms of bodies at a tick [s]
  bool walkers{true};            ///< whether the people on `agents` push plants
  RobotParts robot;              ///< bodies that push plants
  std::vector<FollowedCutter> cutters;
  CanopyScene scene;
};
void describe(FieldVisitor& visitor, CanopyOptions& options);

/// Reads and checks all private parameters and the scenario that they name. Parameters override the
/// scenario. @throws InvalidInput with all faults of both.
CanopyOptions loadCanopyOptions(const ros::NodeHandle& private_handle);

}  // namespace vegetation_sim
