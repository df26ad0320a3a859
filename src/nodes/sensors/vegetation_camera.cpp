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

// A camera's name has letters, digits and underscores only.
std::string nameOf(const ros::NodeHandle& private_handle) {
  std::string out = private_handle.getNamespace().substr(1);
  for (char& c : out)
    if (c == '/') c = '_';
  return out;
}

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
      calibration_(ros::NodeHandle(handle_, "camera"), nameOf(private_handle_)) {
  calibrate();
  start();
}

VegetationCamera::~VegetationCamera() {
  stop();
}

// The lens stays as it is when the service set_camera_info changes the calibration.
void VegetationCamera::calibrate() {
  const std::string& url = options_.camera_info_url;
  if (url.empty()) {
    calibration_.setCameraInfo(toMsg(options_.camera.lens));
    return;
  }
  const std::string context = private_handle_.getNamespace() + "/camera_info_url = '" + url + "'";
  if (!calibration_.validateURL(url) || !calibration_.loadCameraInfo(url))
    throw InvalidInput(context + " is no file:// or package:// address of a calibration",
                       FaultCode::FILE_REJECTED);
  options_.camera.lens = fromMsg(calibration_.getCameraInfo(), context + ": ");
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
  sensor_msgs::CameraInfo info = calibration_.getCameraInfo();
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
