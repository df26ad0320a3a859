// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <image_transport/image_transport.h>
#include <sensor_msgs/SetCameraInfo.h>

#include "nodes/sensors/camera_options.h"
#include "nodes/sensors/lens_calibration.h"
#include "nodes/sensors/sensor_base.h"
#include "sensors/camera/pixels.h"

namespace vegetation_sim {

/// Simulates a camera at a tf frame: picture, depth, labels and instances of one instant.
class VegetationCamera final : public SensorBase {
 public:
  /// @throws InvalidInput for invalid parameters or an invalid calibration.
  VegetationCamera(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
  ~VegetationCamera() override;

 private:
  VegetationCamera(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                   const CameraOptions& options);
  void measure(std::int64_t tick) override;
  void reportValues(Status& status) override;
  bool onSetCalibration(sensor_msgs::SetCameraInfo::Request& request,
                        sensor_msgs::SetCameraInfo::Response& response);
  /// Returns the images that have subscribers.
  scan::Wanted wanted() const;
  void publish(const scan::Images& images, const scan::Wanted& wanted);

  CameraOptions options_;
  image_transport::ImageTransport transport_;
  image_transport::CameraPublisher picture_, depth_;
  image_transport::Publisher label_, instance_;
  LensCalibration calibration_;
  ros::ServiceServer calibration_service_;
  std::uint64_t taken_{0};
  double cost_{0.0};  // wall time of the last images [s]
};

}  // namespace vegetation_sim
