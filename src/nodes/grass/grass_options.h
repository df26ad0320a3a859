// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <vegetation_sim/GrassFieldConfig.h>
#include <vegetation_sim/TreadLaw.h>

#include <optional>
#include <string>
#include <vector>

#include "grass/lod/meadow_lod.h"
#include "grass/tread_simulation.h"
#include "nodes/base/node_options.h"
#include "nodes/cutters/followed_cutter.h"
#include "nodes/grass/cover/grass_cover.h"
#include "ros/params/scene_file.h"
#include "vegetation_sim/grass/lod/colour_mask.h"

namespace vegetation_sim {

/// Everything that can be reconfigured while grass_field runs.
struct GrassTuning {
  double drag{0.2};            ///< of grass, see Field::resistanceAt [N s/m]
  double height_gate{0.3};     ///< of a source without its own [m]
  grass::TreadLaw tread;       ///< likewise
  grass::MeadowSettings view;  ///< of the markers; most_blades follows from their budget
};
void describe(FieldVisitor& visitor, GrassTuning& tuning);
/// @throws InvalidInput with all faults.
void check(GrassTuning tuning);
GrassTuning fromConfig(const GrassFieldConfig& config, const grass::MeadowSettings& view);
/// Writes the tuning into what dynamic_reconfigure shows.
void toConfig(const GrassTuning& tuning, GrassFieldConfig& config);

/// A source that the node finds by itself (N4).
struct FollowedSource {
  std::string name;
  std::string frame;                  ///< tf frame; empty: `odometry` is used
  std::string odometry;               ///< topic of nav_msgs/Odometry
  Vec3 offset{Vec3::Zero()};          ///< in the frame, or in the odometry's child frame [m]
  std::optional<double> height_gate;  ///< none: the node's [m]
  TreadLaw law;                       ///< numbers without their flags are the node's
};

/// The meadow of a scenario file.
struct GrassScene : SceneBase {
  grass::Scene grass;
  std::vector<FollowedSource> sources;
  std::vector<FollowedCutter> cutters;
  std::vector<grass::ColourMask> colours;  ///< discs that colour the grass, at the first tick
};
/// No file gives the default meadow, a file without `grass` one without grass.
/// @throws InvalidInput with all faults of the file.
GrassScene loadGrassScene(const std::string& name);

/// Parameters of grass_field; see docs/reference.md.
struct GrassOptions : NodeOptions {
  double key_frame_period{2.0};   ///< [s]
  int state_bytes{5000000};       ///< of key frames, a second: larger ones come less often [B/s]
  double view_range{500.0};       ///< of viewers in grass/near; 0: there is no limit [m]
  double frame_wait{0.0};         ///< for the transforms of sources at a tick [s]
  double cover_rate{2.0};         ///< [Hz]
  double cover_resolution{0.25};  ///< [m] side of a cell
  CoverScale cover_scale;         ///< values that count as 100
  CoverLayer cover_layer{CoverLayer::CRUSH};  ///< of grass/cover
  std::vector<FollowedSource> sources;
  std::vector<FollowedCutter> cutters;
  GrassTuning tuning;  ///< initial values for dynamic_reconfigure
  GrassScene scene;
};
void describe(FieldVisitor& visitor, GrassOptions& options);

/// Reads and checks all private parameters and the scenario that they name. Parameters override the
/// scenario. @throws InvalidInput with all faults of both.
GrassOptions loadGrassOptions(const ros::NodeHandle& private_handle);

}  // namespace vegetation_sim
