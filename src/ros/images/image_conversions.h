// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <string>
#include <vector>

#include "sensors/camera/camera.h"

namespace vegetation_sim {

/// Images as messages of a size. Left to the caller: the header.
sensor_msgs::Image toImage(const std::vector<scan::Rgb8>& pixels, const scan::Lens& size);
sensor_msgs::Image toImage(const std::vector<float>& pixels, const scan::Lens& size);
sensor_msgs::Image toImage(const std::vector<std::uint16_t>& pixels, const scan::Lens& size);
sensor_msgs::Image toImage(const std::vector<std::int32_t>& pixels, const scan::Lens& size);

/// Returns the calibration of a lens, without rectification. Left to the caller: the header.
sensor_msgs::CameraInfo toMsg(const scan::Lens& lens);
/// Returns the lens of a calibration, which must have no skew, binning or region of interest.
/// @throws InvalidInput with all faults, each with `context`.
scan::Lens fromMsg(const sensor_msgs::CameraInfo& message, const std::string& context);

}  // namespace vegetation_sim
