// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/conversions/scan_conversions.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <numeric>

#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {
namespace {

using sensor_msgs::PointField;

PointField fieldOf(const char* name, std::size_t offset, std::uint8_t type) {
  PointField out;
  out.name = name;
  out.offset = static_cast<std::uint32_t>(offset);
  out.datatype = type;
  out.count = 1;
  return out;
}

bool isBigEndian() {
  const std::uint16_t one = 1;
  std::uint8_t first = 0;
  std::memcpy(&first, &one, 1);
  return first == 0;
}

ScanPoint pointOf(const scan::Return& one, const Vec3& place, double time, int ring) {
  ScanPoint out;
  out.x = static_cast<float>(place.x());
  out.y = static_cast<float>(place.y());
  out.z = static_cast<float>(place.z());
  out.intensity = static_cast<float>(one.intensity);
  out.ring = static_cast<std::uint16_t>(ring);
  out.label = static_cast<std::uint32_t>(one.hit.label);
  out.plant = one.hit.plant;
  out.branch = one.hit.branch;
  out.time = static_cast<float>(time);
  out.return_type = static_cast<std::uint8_t>(one.type);
  return out;
}

}  // namespace

sensor_msgs::PointCloud2 toCloud(const std::vector<scan::Return>& returns, const scan::Lidar& lidar,
                                 const scan::SensorPath& path, PointFrame frame) {
  sensor_msgs::PointCloud2 out;
  out.fields = {fieldOf("x", offsetof(ScanPoint, x), PointField::FLOAT32),
                fieldOf("y", offsetof(ScanPoint, y), PointField::FLOAT32),
                fieldOf("z", offsetof(ScanPoint, z), PointField::FLOAT32),
                fieldOf("intensity", offsetof(ScanPoint, intensity), PointField::FLOAT32),
                fieldOf("label", offsetof(ScanPoint, label), PointField::UINT32),
                fieldOf("plant", offsetof(ScanPoint, plant), PointField::UINT32),
                fieldOf("branch", offsetof(ScanPoint, branch), PointField::INT32),
                fieldOf("time", offsetof(ScanPoint, time), PointField::FLOAT32),
                fieldOf("ring", offsetof(ScanPoint, ring), PointField::UINT16),
                fieldOf("return_type", offsetof(ScanPoint, return_type), PointField::UINT8)};
  std::vector<ScanPoint> points;
  points.reserve(returns.size());
  const int per_ray = scan::returnsPerRay(lidar.model), columns = lidar.beams.columns;
  const scan::BeamDirections directions(lidar.beams);
  for (std::size_t i = 0; i < returns.size(); ++i) {
    if (!returns[i].isPoint()) continue;
    const int ray = static_cast<int>(i) / per_ray, ring = ray / columns, column = ray % columns;
    const double time = scan::timeOf(lidar.beams, column, path.seconds());
    Vec3 place = returns[i].range * directions.at(ring, column);
    if (path.moves() && frame == PointFrame::BEGIN) place = path.toBegin(time, place);
    points.push_back(pointOf(returns[i], place, time, ring));
  }
  out.height = 1;
  out.width = static_cast<std::uint32_t>(points.size());
  out.point_step = sizeof(ScanPoint);
  out.row_step = out.width * out.point_step;
  out.is_bigendian = isBigEndian();
  out.is_dense = true;
  out.data.resize(out.row_step);
  if (!points.empty()) std::memcpy(out.data.data(), points.data(), out.data.size());
  return out;
}

sensor_msgs::LaserScan toScan(const std::vector<scan::Return>& returns, const scan::Beams& beams,
                              double turn) {
  sensor_msgs::LaserScan out;
  const double increment = (beams.azimuth_high - beams.azimuth_low) / beams.columns;
  out.angle_min = static_cast<float>(beams.azimuth_low);
  out.angle_max = static_cast<float>(beams.azimuth_low + increment * (beams.columns - 1));
  out.angle_increment = static_cast<float>(increment);
  out.time_increment = static_cast<float>(scan::timeOf(beams, 1, turn));
  out.range_min = static_cast<float>(beams.range_min);
  out.range_max = static_cast<float>(beams.range_max);
  for (const scan::Return& one : returns) {
    out.ranges.push_back(static_cast<float>(one.range));
    out.intensities.push_back(one.isPoint() ? static_cast<float>(one.intensity) : 0.f);
  }
  return out;
}

ScanReport toReport(const std::vector<scan::Return>& returns, int per_ray,
                    const scan::Scene& scene) {
  ScanReport out;
  const auto counts = scan::countLabels(returns, per_ray);
  static_assert(decltype(out.counts)::static_size == counts.size(), "ScanReport.msg");
  std::copy(counts.begin(), counts.end(), out.counts.begin());
  out.rays = static_cast<std::uint32_t>(returns.size()) / static_cast<std::uint32_t>(per_ray);
  out.second_returns = std::accumulate(counts.begin(), counts.end(), 0U) - out.rays;
  out.trees = static_cast<std::uint32_t>(scene.trees.all().size());
  out.branches = static_cast<std::uint32_t>(scene.trees.branches());
  out.left_out = static_cast<std::uint32_t>(scene.trees.leftOut());
  out.plants = static_cast<std::uint32_t>(scene.plants.all().size());
  out.leaves = static_cast<std::uint32_t>(scene.plants.leaves() + scene.crowns.leaves());
  out.plants_left_out = static_cast<std::uint32_t>(scene.plants.leftOut() + scene.crowns.leftOut());
  return out;
}

SkyView toSkyView(const scan::SkyTransmittance& sky, const Vec3& place, const scan::Scene& scene) {
  SkyView out;
  static_assert(SkyView::ELEVATIONS == scan::SKY_ELEVATIONS &&
                    SkyView::AZIMUTHS == scan::SKY_AZIMUTHS &&
                    decltype(out.transmittance)::static_size == scan::SKY_BINS,
                "SkyView.msg");
  out.position = toPoint(place);
  std::transform(sky.bins.begin(), sky.bins.end(), out.transmittance.begin(),
                 [](double bin) { return static_cast<float>(bin); });
  out.open_share = static_cast<float>(sky.open_share);
  out.sky_view_factor = static_cast<float>(sky.sky_view_factor);
  out.left_out = static_cast<std::uint32_t>(scene.trees.leftOut() + scene.plants.leftOut() +
                                            scene.crowns.leftOut());
  return out;
}

}  // namespace vegetation_sim
