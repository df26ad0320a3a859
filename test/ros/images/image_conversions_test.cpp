// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/images/image_conversions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>

namespace vegetation_sim {
namespace {

scan::Lens sizeOf(int width, int height) {
  scan::Lens out;
  out.width = width;
  out.height = height;
  return out;
}

TEST(ImageConversions, ImagesHaveTheEncodingAndLayoutOfTheirPixels) {
  const scan::Lens size = sizeOf(2, 1);
  const auto colour = toImage(std::vector<scan::Rgb8>{{1, 2, 3}, {4, 5, 6}}, size);
  EXPECT_EQ(colour.encoding, "rgb8");
  EXPECT_EQ(colour.step, 6u);
  EXPECT_EQ(colour.data, (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6}));
  const auto depth = toImage(std::vector<float>{1.5f, 2.5f}, size);
  EXPECT_EQ(depth.encoding, "32FC1");
  EXPECT_EQ(depth.step, 8u);
  float second = 0.f;
  std::memcpy(&second, &depth.data[4], 4);
  EXPECT_EQ(second, 2.5f);
  EXPECT_EQ(toImage(std::vector<std::uint16_t>{1, 2}, size).encoding, "16UC1");
  const auto instance = toImage(std::vector<std::int32_t>{-1, 70000}, size);
  EXPECT_EQ(instance.encoding, "32SC1");
  EXPECT_EQ(instance.width * instance.height, 2u);
  EXPECT_EQ(instance.data.size(), 8u);
}

TEST(ImageConversions, ALensComesBackFromItsCalibration) {
  scan::LensSettings settings;
  settings.distortion = {-0.1, 0.02, 0.001, -0.002, 0.003};
  scan::Lens lens = scan::lensOf(settings);
  lens.fy *= 1.1;
  lens.cx += 3.0;
  const scan::Lens back = fromMsg(toMsg(lens), "lens: ");
  EXPECT_EQ(back.width, lens.width);
  EXPECT_EQ(back.height, lens.height);
  EXPECT_EQ(back.fx, lens.fx);
  EXPECT_EQ(back.fy, lens.fy);
  EXPECT_EQ(back.cx, lens.cx);
  EXPECT_EQ(back.cy, lens.cy);
  EXPECT_EQ(back.distortion.k3, 0.003);
  EXPECT_EQ(back.distortion.p2, -0.002);
}

TEST(ImageConversions, BadCalibrationsAreRejected) {
  const auto refusal = [](const sensor_msgs::CameraInfo& info) {
    try {
      fromMsg(info, "lens: ");
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  sensor_msgs::CameraInfo info = toMsg(scan::lensOf(scan::LensSettings()));
  EXPECT_EQ(refusal(info), "");
  info.width = 4000000000U;
  EXPECT_NE(refusal(info).find("lens: width = 4097"), std::string::npos) << refusal(info);
  info.D.resize(4);
  EXPECT_NE(refusal(info).find("lens: D has 4 numbers, allowed are 5"), std::string::npos);
  info.distortion_model = "rational_polynomial";
  EXPECT_NE(refusal(info).find("distortion_model = 'rational_polynomial' is not plumb_bob"),
            std::string::npos);
}

TEST(ImageConversions, CalibrationsWithSkewBinningOrRegionAreRejected) {
  const sensor_msgs::CameraInfo good = toMsg(scan::lensOf(scan::LensSettings()));
  const auto refusal = [&](const std::function<void(sensor_msgs::CameraInfo&)>& change) {
    sensor_msgs::CameraInfo info = good;
    change(info);
    try {
      fromMsg(info, "lens: ");
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal([](auto& i) { i.K[1] = 2; }).find("lens: K[1] = 2 is outside 0 to 0"),
            std::string::npos);
  EXPECT_NE(refusal([](auto& i) { i.R[4] = NAN; }).find("lens: R[4] = nan"), std::string::npos);
  EXPECT_NE(refusal([](auto& i) { i.P[3] = 1e7; }).find("lens: P[3] = 1e+07"), std::string::npos);
  EXPECT_NE(refusal([](auto& i) { i.binning_y = 3; }).find("lens: binning_y = 3"),
            std::string::npos);
  EXPECT_NE(refusal([](auto& i) { i.roi.width = 3; }).find("lens: roi.width = 3 is outside 320"),
            std::string::npos);
  EXPECT_EQ(refusal([](auto& i) { i.roi.width = i.width; }), "");
}

}  // namespace
}  // namespace vegetation_sim
