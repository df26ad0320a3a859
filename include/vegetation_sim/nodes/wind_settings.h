// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "vegetation_sim/ros/parameters.h"
#include "vegetation_sim/wind/source.h"

namespace vegetation_sim {

/// The breeze that dynamic_reconfigure edits: the source named "breeze".
struct BreezeSettings {
  static constexpr const char* NAME = "breeze";

  double speed{0.0};       ///< [m/s]
  double direction{0.0};   ///< where the air goes, from east, counter-clockwise [rad]
  double turbulence{0.2};  ///< rms along the wind / mean

  /// @param base of which everything else is kept.
  wind::Primitive applyTo(wind::Primitive base) const;
  /// @param direction_in_a_calm kept where the speed is zero [rad].
  static BreezeSettings of(const wind::Primitive& primitive, double direction_in_a_calm);
};

void describe(FieldVisitor& visitor, BreezeSettings& breeze);

/// What a wind_broadcaster is started with.
struct WindSettings {
  std::string frame_id{"map"};        ///< world frame
  std::uint64_t seed{0};              ///< of the turbulence
  double lead{0.2};                   ///< how far ahead an edit takes effect [s]
  double attach_rate{5.0};            ///< samples and pieces of followed frames [Hz]
  double attach_horizon{2.0};         ///< how long a piece outlasts its last sample [s]
  double markers_rate{10.0};          ///< [Hz]
  std::vector<wind::Source> sources;  ///< stamps from 0, the start of the node
  BreezeSettings breeze;              ///< of the source named "breeze", if there is one
};

/// Reads the private parameters, and the scenario that they name. Parameters win over the scenario,
/// but for its own source named "breeze", which wins over what dynamic_reconfigure left behind.
/// @throws InvalidInput with all faults of both.
WindSettings readWindSettings(const ros::NodeHandle& private_nh);

}  // namespace vegetation_sim
