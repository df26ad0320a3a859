// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

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
};

}  // namespace vegetation_sim
