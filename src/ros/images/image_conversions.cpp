// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/images/image_conversions.h"

#include <sensor_msgs/distortion_models.h>
#include <sensor_msgs/image_encodings.h>
#include <Eigen/LU>

#include <algorithm>
#include <cstring>

namespace vegetation_sim {
namespace {

namespace encodings = sensor_msgs::image_encodings;

bool isBigEndian() {
  const std::uint16_t one = 1;
  std::uint8_t first = 0;
  std::memcpy(&first, &one, 1);
  return first == 0;
}

template <class Value>
sensor_msgs::Image imageOf(const std::vector<Value>& pixels, const scan::Lens& size,
                           const std::string& encoding) {
  sensor_msgs::Image out;
  out.width = static_cast<std::uint32_t>(size.width);
  out.height = static_cast<std::uint32_t>(size.height);
  out.encoding = encoding;
  out.is_bigendian = isBigEndian();
  out.step = out.width * static_cast<std::uint32_t>(sizeof(Value));
  out.data.resize(pixels.size() * sizeof(Value));
  if (!pixels.empty()) std::memcpy(out.data.data(), pixels.data(), out.data.size());
  return out;
}

// A picture has no rectification, binning or region of interest, so these are refused.
void checkRest(const sensor_msgs::CameraInfo& info, const std::string& context, Faults& faults) {
  const auto allow = [&](const std::string& name, double value, double low, double high) {
    FieldChecker(context, faults).number(name.c_str(), value, "", {low, high});
  };
  for (const std::size_t i : {1, 3, 6, 7}) allow("K[" + std::to_string(i) + "]", info.K[i], 0, 0);
  allow("K[8]", info.K[8], 1, 1);
  // Without distortion nodes take the picture as a rectified one.
  const bool is_rectified =
      std::all_of(info.D.begin(), info.D.end(), [](double d) { return d == 0; });
  const auto expect = [&](const char* name, std::size_t i, double value, double wanted) {
    allow(name + ("[" + std::to_string(i) + "]"), value, wanted - 1e-3, wanted + 1e-3);
  };
  for (std::size_t i = 0; i < info.R.size(); ++i)
    if (is_rectified)
      expect("R", i, info.R[i], i % 4 == 0 ? 1.0 : 0.0);
    else
      allow("R[" + std::to_string(i) + "]", info.R[i], -1, 1);
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> turn(info.R.data());
  if (!is_rectified && !((turn * turn.transpose()).isIdentity(1e-3) && turn.determinant() > 0.0))
    faults.add(context + "R is no rotation");
  for (std::size_t i = 0; i < info.P.size(); ++i)
    if (is_rectified && i % 4 < 3)
      expect("P", i, info.P[i], info.K[3 * (i / 4) + i % 4]);
    else if (i == 0 || i == 5)
      allow("P[" + std::to_string(i) + "]", info.P[i], 1e-3, 1e6);
    else
      allow("P[" + std::to_string(i) + "]", info.P[i], -1e6, 1e6);
  allow("binning_x", info.binning_x, 0, 1);
  allow("binning_y", info.binning_y, 0, 1);
  allow("roi.x_offset", info.roi.x_offset, 0, 0);
  allow("roi.y_offset", info.roi.y_offset, 0, 0);
  if (info.roi.width != 0) allow("roi.width", info.roi.width, info.width, info.width);
  if (info.roi.height != 0) allow("roi.height", info.roi.height, info.height, info.height);
}

}  // namespace

static_assert(sizeof(scan::Rgb8) == 3, "no gaps");

sensor_msgs::Image toImage(const std::vector<scan::Rgb8>& pixels, const scan::Lens& size) {
  return imageOf(pixels, size, encodings::RGB8);
}
sensor_msgs::Image toImage(const std::vector<float>& pixels, const scan::Lens& size) {
  return imageOf(pixels, size, encodings::TYPE_32FC1);
}
sensor_msgs::Image toImage(const std::vector<std::uint16_t>& pixels, const scan::Lens& size) {
  return imageOf(pixels, size, encodings::TYPE_16UC1);
}
sensor_msgs::Image toImage(const std::vector<std::int32_t>& pixels, const scan::Lens& size) {
  return imageOf(pixels, size, encodings::TYPE_32SC1);
}

sensor_msgs::CameraInfo toMsg(const scan::Lens& lens) {
  sensor_msgs::CameraInfo out;
  const scan::Distortion& d = lens.distortion;
  out.width = static_cast<std::uint32_t>(lens.width);
  out.height = static_cast<std::uint32_t>(lens.height);
  out.distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  out.D = {d.k1, d.k2, d.p1, d.p2, d.k3};
  out.K = {lens.fx, 0.0, lens.cx, 0.0, lens.fy, lens.cy, 0.0, 0.0, 1.0};
  out.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  out.P = {lens.fx, 0.0, lens.cx, 0.0, 0.0, lens.fy, lens.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return out;
}

scan::Lens fromMsg(const sensor_msgs::CameraInfo& message, const std::string& context) {
  Faults faults;
  if (message.distortion_model != sensor_msgs::distortion_models::PLUMB_BOB)
    faults.add(context + "distortion_model = " + inQuotes(message.distortion_model) +
               " is not plumb_bob");
  if (message.D.size() != 5)
    faults.add(context + "D has " + std::to_string(message.D.size()) + " numbers, allowed are 5");
  faults.throwIfAny();
  scan::Lens out;
  const auto sizeOf = [](std::uint32_t size) {
    return static_cast<int>(std::min<std::uint32_t>(size, scan::MOST_PIXELS_OF_SIDE + 1));
  };
  out.width = sizeOf(message.width);
  out.height = sizeOf(message.height);
  out.fx = message.K[0];
  out.fy = message.K[4];
  out.cx = message.K[2];
  out.cy = message.K[5];
  out.distortion = {message.D[0], message.D[1], message.D[2], message.D[3], message.D[4]};
  scan::check(out, context, faults);
  checkRest(message, context, faults);
  faults.throwIfAny();
  return out;
}

}  // namespace vegetation_sim
