// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/sensors/vegetation_camera.h"

#include "nodes/base/node_factory.h"

#include "ros/images/image_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr std::uint32_t QUEUE = 4;
constexpr std::uint64_t CAMERA = 2;  // of NoiseKeys, beside the scans of a lidar

}  // namespace

VegetationCamera::VegetationCamera(const ros::NodeHandle& handle,
                                   const ros::NodeHandle& private_handle)
    : VegetationCamera(handle, private_handle, loadCameraOptions(private_handle)) {}

VegetationCamera::VegetationCamera(const ros::NodeHandle& handle,
                                   const ros::NodeHandle& private_handle,
                                   const CameraOptions& options)
    : SensorBase("vegetation_camera", handle, private_handle, options, "camera", "images"),
      options_(options),
      transport_(handle_),
      picture_(transport_.advertiseCamera("camera/image_raw", QUEUE)),
      depth_(transport_.advertiseCamera("camera/depth/image_raw", QUEUE)),
      label_(transport_.advertise("camera/label", QUEUE)),
      instance_(transport_.advertise("camera/instance", QUEUE)),
      calibration_(private_handle_, options_.camera_info_url, options_.camera.lens),
      calibration_service_(handle_.advertiseService("camera/set_camera_info",
                                                    &VegetationCamera::onSetCalibration, this)) {
  options_.camera.lens = calibration_.lens();
  start();
}

VegetationCamera::~VegetationCamera() {
  stop();
}

// The response has no `message`, which answer() would need.
bool VegetationCamera::onSetCalibration(sensor_msgs::SetCameraInfo::Request& request,
                                        sensor_msgs::SetCameraInfo::Response& response) {
  try {
    response.status_message = calibration_.replace(request.camera_info);
    response.success = true;
    options_.camera.lens = calibration_.lens();
  } catch (const std::exception& error) {
    response.success = false;
    response.status_message = error.what();
    refused_requests_.add("set_camera_info", error.what());
  }
  return true;
}

scan::Wanted VegetationCamera::wanted() const {
  return {picture_.getNumSubscribers() > 0, depth_.getNumSubscribers() > 0,
          label_.getNumSubscribers() > 0, instance_.getNumSubscribers() > 0};
}

void VegetationCamera::measure(std::int64_t tick) {
  const scan::Wanted images = wanted();
  const scan::Camera& camera = options_.camera;
  Pose pose;
  if (!findPose(options_.camera_frame, clock_.stamp(), images.any(), pose)) return;
  announce("", pose.position, camera.range_max);
  if (!images.any()) return;
  const ros::WallTime start = ros::WallTime::now();
  landscape_.update(pose.position, camera.range_max, clock_.stamp(), scene_, threads_);
  const scan::NoiseKeys noise{options_.seed, static_cast<std::uint64_t>(tick), CAMERA};
  publish(scan::takeImages(scene_, camera, pose, noise, images, threads_), images);
  cost_ = (ros::WallTime::now() - start).toSec();
  ++taken_;
}

void VegetationCamera::publish(const scan::Images& images, const scan::Wanted& wanted) {
  sensor_msgs::CameraInfo info = calibration_.info();
  info.header.stamp = toStamp(clock_.stamp());
  info.header.frame_id = options_.camera_frame;
  const auto image = [&](const auto& pixels) {
    sensor_msgs::Image out = toImage(pixels, options_.camera.lens);
    out.header = info.header;
    return out;
  };
  if (wanted.colour) picture_.publish(image(images.colour), info);
  if (wanted.depth) depth_.publish(image(images.depth), info);
  if (wanted.label) label_.publish(image(images.label));
  if (wanted.instance) instance_.publish(image(images.instance));
}

void VegetationCamera::reportValues(Status& status) {
  status.add("Images", taken_);
  status.add("Images without a place", unplaced_);
  status.add("Wall time of the images [ms]", 1e3 * cost_);
}

std::shared_ptr<void> createVegetationCamera(const ros::NodeHandle& handle,
                                             const ros::NodeHandle& private_handle) {
  return std::make_shared<VegetationCamera>(handle, private_handle);
}

}  // namespace vegetation_sim
