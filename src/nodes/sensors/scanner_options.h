// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "sensors/lidar.h"
#include "sensors/sensor_scene.h"

namespace vegetation_sim {

/// Whether the sensor moves within a sweep. NONE: all rays have the pose at the stamp. DESKEWED:
/// points are in the frame of the sensor at the stamp. RAW: each is in the frame at its own
/// instant.
enum class SweepMotion { NONE, DESKEWED, RAW };

/// Parameters of vegetation_scanner; see docs/reference.md.
struct ScanOptions {
  std::string frame_id{"map"};       ///< world frame
  std::string lidar_frame{"lidar"};  ///< tf frame of the sensor: x forward, z up; empty: none
  std::uint64_t seed{0};             ///< of the noise
  double delay{0.1};                 ///< how far sweeps stay behind the clock [s]
  double tolerance{0.05};            ///< error that branches in range may have [m]
  int branch_budget{400000};         ///< most branches that rays can meet
  int leaf_budget{200000};           ///< most leaves of plants that rays can meet
  int threads{1};                    ///< of a sweep
  SweepMotion motion{SweepMotion::NONE};
  double sky_range{60.0};               ///< of objects that hide the sky [m]
  std::vector<std::string> sky_frames;  ///< tf frames at which views of the sky are published
  scan::Lidar lidar;
};
void describe(FieldVisitor& visitor, ScanOptions& options);

/// Reads and checks all private parameters. @throws InvalidInput with all faults.
ScanOptions loadScanOptions(const ros::NodeHandle& private_handle);

/// Returns an empty scene with the budgets of the options.
scan::Scene makeScene(const ScanOptions& options);

}  // namespace vegetation_sim
