// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <vegetation_sim/AgentCrowdConfig.h>

#include <string>
#include <vector>

#include "crowd/agents/crowd_scene.h"
#include "crowd/body/motion_style.h"
#include "nodes/base/node_options.h"
#include "ros/conversions/crowd_conversions.h"
#include "ros/params/scene_file.h"

namespace vegetation_sim {

/// How walkers tread (S2-36): not at all, as one source a walker, or with each foot where it comes
/// down.
enum class Treading : int { NONE = 0, BODY = 1, FEET = 2 };

/// The people of a scenario file.
struct CrowdScene : SceneBase {
  crowd::Scene crowd;
  std::vector<crowd::Robot> robots;
  crowd::MotionStyles motions{crowd::ownStyles()};
};
/// No file or no `crowd` in it gives no walkers. @throws InvalidInput with all faults of the file.
CrowdScene loadCrowdScene(const std::string& name);

/// Parameters of agent_crowd; see docs/reference.md.
struct CrowdOptions : NodeOptions {
  CrowdOptions() { marker_points = 120000; }

  double tolerance{1.0};     ///< error of drawn walkers [pixel]
  double frame_wait{0.0};    ///< for the robots and the cover map of a tick [s]
  double tf_rate{15.0};      ///< [Hz]
  int tf_budget{20};         ///< frames: nearest to robots, then lowest ids
  std::string frame_prefix;  ///< precedes walker_<id>
  Treading tread{Treading::BODY};
  double tread_radius{0.0};  ///< 0: 0.16 of a body, 0.06 of a foot [m]
  double cover_rate{0.0};    ///< of the meadow whose cover maps ticks await [Hz]; 0: none
  int tread_ahead{0};        ///< ticks from that of the people to that of their treads
  TrunkShape trunks{TrunkShape::ROUND};
  int most_trunks{100000};           ///< near the area
  int most_walkers{5000};            ///< requests for more are rejected
  int threads{1};                    ///< of a tick
  double view_range{500.0};          ///< of viewers in agents/view; 0: there is no limit [m]
  std::vector<crowd::Robot> robots;  ///< id: tf frame; footprint
  crowd::MotionStyles motions;       ///< styles of which each person has one
  crowd::CrowdSettings tuning;       ///< initial values for dynamic_reconfigure
  CrowdScene scene;
};
void describe(FieldVisitor& visitor, CrowdOptions& options);

/// Reads and checks all private parameters and the scenario that they name. Parameters override the
/// scenario. @throws InvalidInput with all faults of both.
CrowdOptions loadCrowdOptions(const ros::NodeHandle& private_handle);

/// Converts to and from dynamic_reconfigure; `other` has the fields that it does not show.
void toConfig(const crowd::CrowdSettings& settings, AgentCrowdConfig& config);
crowd::CrowdSettings fromConfig(const AgentCrowdConfig& config, const crowd::CrowdSettings& other);

}  // namespace vegetation_sim
