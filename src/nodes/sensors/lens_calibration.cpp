// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/sensors/lens_calibration.h"

#include <camera_calibration_parsers/parse.h>
#include <ros/service_manager.h>

#include <filesystem>
#include <system_error>

#include "ros/images/image_conversions.h"
#include "ros/params/resources.h"

namespace vegetation_sim {
namespace {

const std::string UNUSED = "unused";  // namespace of the service of camera_info_manager

// A camera's name has letters, digits and underscores only.
std::string nameOf(const ros::NodeHandle& private_handle) {
  std::string out = private_handle.getNamespace().substr(1);
  for (char& c : out)
    if (c == '/') c = '_';
  return out;
}

void checkSize(Faults& faults, const char* name, std::uint32_t size, int own) {
  if (size != static_cast<std::uint32_t>(own))
    faults.add(std::string(name) + " = " + std::to_string(size) +
               " pixel, allowed is that of the camera, " + std::to_string(own) + " pixel");
}

}  // namespace

LensCalibration::LensCalibration(const ros::NodeHandle& private_handle, const std::string& url,
                                 const scan::Lens& lens)
    : name_(nameOf(private_handle)),
      url_(url),
      context_(private_handle.getNamespace() + "/camera_info_url = '" + url + "'"),
      manager_(ros::NodeHandle(private_handle, UNUSED), name_),
      info_(toMsg(lens)),
      lens_(lens) {
  ros::ServiceManager::instance()->unadvertiseService(
      ros::NodeHandle(private_handle, UNUSED).resolveName("set_camera_info"));
  if (!url_.empty()) load();
}

void LensCalibration::load() {
  if (!manager_.validateURL(url_) || !manager_.loadCameraInfo(url_))
    throw InvalidInput(context_ + " is no file:// or package:// address of a calibration",
                       FaultCode::FILE_REJECTED);
  info_ = manager_.getCameraInfo();
  lens_ = fromMsg(info_, context_ + ": ");
}

std::string LensCalibration::replace(const sensor_msgs::CameraInfo& info) {
  Faults faults;
  checkSize(faults, "width", info.width, lens_.width);
  checkSize(faults, "height", info.height, lens_.height);
  faults.throwIfAny();
  const scan::Lens lens = fromMsg(info, "");
  if (!url_.empty()) save(info);
  lens_ = lens;
  info_ = info;
  return url_.empty() ? "the pictures follow the calibration until the node ends; it is not saved "
                        "without camera_info_url"
                      : "the pictures follow the calibration, which is saved in " + url_;
}

// The old file stays whole until the new one is complete.
void LensCalibration::save(const sensor_msgs::CameraInfo& info) {
  namespace files = std::filesystem;
  const files::path file = resolveFile(manager_.resolveURL(url_, name_));
  const files::path draft = file.parent_path() / (".new_" + file.filename().string());
  std::error_code failure;
  if (camera_calibration_parsers::writeCalibration(draft.string(), name_, info))
    files::rename(draft, file, failure);
  else
    failure = std::make_error_code(std::errc::io_error);
  if (!failure) return;
  std::error_code ignored;
  files::remove(draft, ignored);
  throw InvalidInput(context_ + " cannot be written", FaultCode::FILE_REJECTED);
}

}  // namespace vegetation_sim
