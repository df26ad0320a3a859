// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "nodes/sensors/sensor_options.h"
#include "sensors/lidar.h"

namespace vegetation_sim {

/// Whether the sensor moves within a sweep. NONE: all rays have the pose at the stamp. DESKEWED:
/// points are in the frame of the sensor at the stamp. RAW: each is in the frame at its own
/// instant.
enum class SweepMotion { NONE, DESKEWED, RAW };

/// Parameters of vegetation_scanner; see docs/reference.md.
struct ScanOptions : SensorOptions {
  std::string lidar_frame{"lidar"};  ///< tf frame of the sensor: x forward, z up; empty: none
  SweepMotion motion{SweepMotion::NONE};
  double sky_range{60.0};               ///< of objects that hide the sky [m]
  std::vector<std::string> sky_frames;  ///< tf frames at which views of the sky are published
  scan::Lidar lidar;
};
void describe(FieldVisitor& visitor, ScanOptions& options);

/// Reads and checks all private parameters. @throws InvalidInput with all faults.
ScanOptions loadScanOptions(const ros::NodeHandle& private_handle);

}  // namespace vegetation_sim
