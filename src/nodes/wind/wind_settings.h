// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <vegetation_sim/WindBroadcasterConfig.h>

#include <string>
#include <vector>

#include "nodes/snapshots/snapshot_folder.h"
#include "ros/params/parameters.h"
#include "vegetation_sim/wind/source.h"
#include "wind/schedule/primitive_schedule.h"

namespace vegetation_sim {

/// The breeze that dynamic_reconfigure edits: the source named "breeze".
struct BreezeSettings {
  static constexpr const char* NAME = "breeze";

  double speed{0.0};       ///< [m/s]
  double direction{0.0};   ///< of the velocity, from east, counter-clockwise [rad]
  double turbulence{0.2};  ///< rms along the wind / mean

  /// @param base has all other fields.
  wind::Primitive applyTo(wind::Primitive base) const;
  /// @param direction_in_a_calm result for a speed of zero [rad].
  static BreezeSettings of(const wind::Primitive& primitive, double direction_in_a_calm);

  bool operator==(const BreezeSettings& other) const {
    return speed == other.speed && direction == other.direction && turbulence == other.turbulence;
  }
  bool operator!=(const BreezeSettings& other) const { return !(*this == other); }
};

WindBroadcasterConfig toConfig(const BreezeSettings& breeze);
BreezeSettings fromConfig(const WindBroadcasterConfig& config);

void describe(FieldVisitor& visitor, BreezeSettings& breeze);

/// Parameters and scenario of wind_broadcaster.
struct WindSettings {
  /// Frames that may be followed at once: their pieces share the field's limit with all sources.
  static constexpr std::size_t MAX_FOLLOWED = 4;

  std::string frame_id{"map"};             ///< world frame
  std::uint64_t seed{0};                   ///< of the turbulence
  double lead{0.2};                        ///< how far ahead an edit takes effect [s]
  double attach_rate{5.0};                 ///< samples and pieces of followed frames [Hz]
  double attach_horizon{2.0};              ///< how long a piece outlasts its last sample [s]
  double markers_rate{10.0};               ///< [Hz]
  double sample_rate{30.0};                ///< [Hz]
  std::vector<std::string> sample_frames;  ///< tf frames at which the wind is published
  std::vector<wind::Source> sources;       ///< stamps from 0, the start of the node
  BreezeSettings breeze;                   ///< of the source named "breeze", if there is one
  SnapshotOptions snapshots;
};

/// Reads the private parameters and the scenario that they name. Parameters override the scenario,
/// except its source named "breeze", which overrides the values that dynamic_reconfigure has left.
/// @throws InvalidInput with all faults of both.
WindSettings readWindSettings(const ros::NodeHandle& private_nh);

/// Returns the schedule of a start at a stamp, without the sources that follow a frame.
/// @throws InvalidInput if the sources do not fit in one field.
wind::PrimitiveSchedule initialSchedule(const WindSettings& settings, Nanoseconds start);

}  // namespace vegetation_sim
