// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <string>

#include "nodes/sensors/sensor_options.h"
#include "sensors/camera/camera.h"

namespace vegetation_sim {

/// Parameters of vegetation_camera; see docs/reference.md.
struct CameraOptions : SensorOptions {
  CameraOptions() { rate = 5; }

  /// tf frame of the camera (REP 103): x right, y down, z forward.
  std::string camera_frame{"camera_optical_frame"};
  std::string camera_info_url;  ///< calibration of the lens; empty: `lens`
  scan::LensSettings lens;
  scan::Camera camera;
};
void describe(FieldVisitor& visitor, CameraOptions& options);

/// Reads and checks all private parameters. @throws InvalidInput with all faults.
CameraOptions loadCameraOptions(const ros::NodeHandle& private_handle);

}  // namespace vegetation_sim
