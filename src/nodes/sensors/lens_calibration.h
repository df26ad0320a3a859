// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <camera_info_manager/camera_info_manager.h>

#include <string>

#include "sensors/camera/lens.h"

namespace vegetation_sim {

/// The lens of a camera and its calibration, which agree. Files are read as camera_info_manager
/// reads them. Its service takes any calibration, so the node has to offer its own.
class LensCalibration {
 public:
  /// @param url file of the calibration; empty: that of `lens`. @throws InvalidInput.
  LensCalibration(const ros::NodeHandle& private_handle, const std::string& url,
                  const scan::Lens& lens);

  const scan::Lens& lens() const { return lens_; }
  /// Returns the calibration; left to the caller: the header.
  const sensor_msgs::CameraInfo& info() const { return info_; }
  /// Replaces lens and calibration, and the file if there is one. Returns what was done.
  /// @throws InvalidInput with all faults, or that the file cannot be written; then nothing
  /// changes.
  std::string replace(const sensor_msgs::CameraInfo& info);

 private:
  void load();
  void save(const sensor_msgs::CameraInfo& info);

  std::string name_, url_, context_;  // context_ begins the faults of the file
  camera_info_manager::CameraInfoManager manager_;
  sensor_msgs::CameraInfo info_;
  scan::Lens lens_;
};

}  // namespace vegetation_sim
