// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/conversions/scan_conversions.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

namespace vegetation_sim {
namespace {

using sensor_msgs::PointField;

/// Returns the returns of two rings of one beam, a branch and a person.
std::vector<scan::Return> twoReturns() {
  std::vector<scan::Return> out(2);
  out[0].range = 4.0;
  out[0].hit.label = scan::Label::BRANCH;
  out[0].hit.plant = 70000;
  out[0].hit.branch = 12;
  out[1].range = 2.0;
  out[1].hit.label = scan::Label::PERSON;
  out[1].hit.plant = 3;
  out[1].hit.branch = -1;
  return out;
}

sensor_msgs::PointCloud2 cloudOf(const std::vector<scan::Return>& returns,
                                 scan::ReturnMode mode = scan::ReturnMode::STRONGEST,
                                 const scan::SensorPath& path = Pose(),
                                 PointFrame frame = PointFrame::BEGIN) {
  scan::Lidar lidar;
  lidar.beams.rings = 2;
  lidar.beams.columns = static_cast<int>(returns.size()) / 2;
  lidar.model.returns = mode;
  if (mode == scan::ReturnMode::BOTH) lidar.beams.rings = 1;
  return toCloud(returns, lidar, path, frame);
}

const PointField* findField(const sensor_msgs::PointCloud2& cloud, const std::string& name) {
  for (const PointField& field : cloud.fields)
    if (field.name == name) return &field;
  return nullptr;
}

template <class T>
T valueOf(const sensor_msgs::PointCloud2& cloud, std::size_t point, const std::string& name) {
  T out;
  std::memcpy(&out, &cloud.data[point * cloud.point_step + findField(cloud, name)->offset],
              sizeof(out));
  return out;
}

// pcl::fromROSMsg takes a field only if its name, type and count are those of the point type. These
// are registered in pcl/impl/point_types.hpp: PointXYZL and PointXYZI.
TEST(ScanConversions, FieldsAreThoseOfPclPointTypes) {
  const sensor_msgs::PointCloud2 cloud = cloudOf(twoReturns());
  const std::pair<const char*, std::uint8_t> wanted[] = {
      {"x", PointField::FLOAT32},         {"y", PointField::FLOAT32},
      {"z", PointField::FLOAT32},         {"label", PointField::UINT32},
      {"intensity", PointField::FLOAT32}, {"time", PointField::FLOAT32},
      {"ring", PointField::UINT16},       {"return_type", PointField::UINT8}};
  for (const auto& [name, type] : wanted) {
    const PointField* field = findField(cloud, name);
    ASSERT_TRUE(field) << name;
    EXPECT_EQ(field->datatype, type) << name;
    EXPECT_EQ(field->count, 1u) << name;
  }
  // x, y and z lie one after the other, as PCL copies them.
  EXPECT_EQ(findField(cloud, "y")->offset, findField(cloud, "x")->offset + 4);
  EXPECT_EQ(findField(cloud, "z")->offset, findField(cloud, "x")->offset + 8);
}

TEST(ScanConversions, FieldsNeitherOverlapNorLeaveThePoint) {
  const sensor_msgs::PointCloud2 cloud = cloudOf(twoReturns());
  std::vector<int> used(cloud.point_step);
  for (const PointField& field : cloud.fields) {
    const std::uint32_t size = field.datatype == PointField::UINT8    ? 1
                               : field.datatype == PointField::UINT16 ? 2
                                                                      : 4;
    ASSERT_LE(field.offset + size, cloud.point_step) << field.name;
    for (std::uint32_t i = 0; i < size; ++i) EXPECT_EQ(used[field.offset + i]++, 0) << field.name;
  }
  EXPECT_EQ(cloud.row_step, cloud.width * cloud.point_step);
  EXPECT_EQ(cloud.data.size(), cloud.row_step);
}

TEST(ScanConversions, APointHasTheValuesOfItsReturn) {
  const sensor_msgs::PointCloud2 cloud = cloudOf(twoReturns());
  ASSERT_EQ(cloud.width, 2u);
  EXPECT_EQ(valueOf<std::uint32_t>(cloud, 0, "label"), std::uint32_t{ScanReport::BRANCH});
  EXPECT_EQ(valueOf<std::uint32_t>(cloud, 0, "plant"), 70000u);
  EXPECT_EQ(valueOf<std::int32_t>(cloud, 0, "branch"), 12);
  EXPECT_EQ(valueOf<std::uint16_t>(cloud, 0, "ring"), 0);
  EXPECT_EQ(valueOf<std::uint32_t>(cloud, 1, "label"), std::uint32_t{ScanReport::PERSON});
  EXPECT_EQ(valueOf<std::int32_t>(cloud, 1, "branch"), -1);
  EXPECT_EQ(valueOf<std::uint16_t>(cloud, 1, "ring"), 1);
  EXPECT_EQ(valueOf<float>(cloud, 1, "time"), 0.f);  // all rays of a sweep share one instant
}

TEST(ScanConversions, BothReturnsOfARayAreInItsDirection) {
  std::vector<scan::Return> returns = twoReturns();
  returns[0].type = scan::ReturnType::DUAL_WEAK_LAST;
  returns[1].type = scan::ReturnType::DUAL_STRONGEST_FIRST;
  const auto cloud = cloudOf(returns, scan::ReturnMode::BOTH);
  ASSERT_EQ(cloud.width, 2u);
  EXPECT_EQ(valueOf<std::uint8_t>(cloud, 0, "return_type"), 6);
  EXPECT_EQ(valueOf<std::uint8_t>(cloud, 1, "return_type"), 3);
  for (const char* name : {"x", "y", "z"})
    EXPECT_NEAR(valueOf<float>(cloud, 0, name), 2.0 * valueOf<float>(cloud, 1, name), 1e-5);
  const ScanReport report = toReport(returns, 2, scan::Scene());
  EXPECT_EQ(report.rays, 1u);
  EXPECT_EQ(report.second_returns, 1u);
  returns[1] = scan::Return();
  EXPECT_EQ(toReport(returns, 2, scan::Scene()).second_returns, 0u);
}

// The sensor moves by 1 m along x in the 0.1 s of a turn; its second column is half a turn later.
TEST(ScanConversions, PointsOfASensorThatMovesHaveTimesAndAFrame) {
  std::vector<scan::Return> returns(4);
  for (scan::Return& one : returns) one.range = 5.0;
  Pose end;
  end.position = Vec3(1.0, 0.0, 0.0);
  const scan::SensorPath path(Pose(), end, 0.1);
  const auto still = cloudOf(returns);
  for (const PointFrame frame : {PointFrame::BEGIN, PointFrame::RAY}) {
    const auto cloud = cloudOf(returns, scan::ReturnMode::STRONGEST, path, frame);
    EXPECT_EQ(valueOf<float>(cloud, 0, "time"), 0.f);
    EXPECT_NEAR(valueOf<float>(cloud, 1, "time"), 0.05, 1e-6);
    EXPECT_EQ(valueOf<float>(cloud, 0, "x"), valueOf<float>(still, 0, "x"));
    EXPECT_NEAR(valueOf<float>(cloud, 1, "x") - valueOf<float>(still, 1, "x"),
                frame == PointFrame::BEGIN ? 0.5 : 0.0, 1e-5);
  }
}

TEST(ScanConversions, APlanarScanOfASensorThatMovesHasTheTimeBetweenItsRays) {
  std::vector<scan::Return> returns(4);
  scan::Beams beams;
  beams.rings = 1;
  beams.columns = 4;
  EXPECT_NEAR(toScan(returns, beams, 0.1).time_increment, 0.025, 1e-6);
  EXPECT_EQ(toScan(returns, beams, 0.0).time_increment, 0.f);
}

TEST(ScanConversions, AViewOfTheSkyHasItsBinsInOrder) {
  scan::SkyTransmittance sky;
  for (std::size_t bin = 0; bin < scan::SKY_BINS; ++bin) sky.bins[bin] = 0.001 * double(bin);
  sky.open_share = 0.25;
  sky.sky_view_factor = 0.5;
  const SkyView view = toSkyView(sky, Vec3(1.0, 2.0, 3.0), scan::Scene());
  for (std::size_t bin = 0; bin < scan::SKY_BINS; ++bin)
    EXPECT_EQ(view.transmittance[bin], static_cast<float>(sky.bins[bin]));
  EXPECT_EQ(view.open_share, 0.25f);
  EXPECT_EQ(view.sky_view_factor, 0.5f);
  EXPECT_EQ(view.position.z, 3.0);
  EXPECT_EQ(view.left_out, 0u);
}

}  // namespace
}  // namespace vegetation_sim
