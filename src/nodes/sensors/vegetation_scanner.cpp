// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/sensors/vegetation_scanner.h"

#include "nodes/base/node_factory.h"

#include <algorithm>

#include "ros/conversions/scan_conversions.h"
#include "sensors/sweep.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {

VegetationScanner::VegetationScanner(const ros::NodeHandle& handle,
                                     const ros::NodeHandle& private_handle)
    : VegetationScanner(handle, private_handle, loadScanOptions(private_handle)) {}

VegetationScanner::VegetationScanner(const ros::NodeHandle& handle,
                                     const ros::NodeHandle& private_handle,
                                     const ScanOptions& options)
    : SensorBase("vegetation_scanner", handle, private_handle, options, "scan", "sweeps"),
      options_(options),
      sky_of_frames_(options_, landscape_, threads_,
                     std::max<std::size_t>(options_.sky_frames.size(), 1)),
      sky_of_requests_(options_, landscape_, threads_, 1),
      cloud_publisher_(handle_.advertise<sensor_msgs::PointCloud2>("lidar/points", 10)),
      scan_publisher_(handle_.advertise<sensor_msgs::LaserScan>("lidar/scan", 10)),
      report_publisher_(handle_.advertise<ScanReport>("lidar/report", 10)),
      sky_publisher_(handle_.advertise<SkyViews>("sky_view", 10)) {
  serve("sky_view", &VegetationScanner::onSkyView);
  start();
}

VegetationScanner::~VegetationScanner() {
  stop();
}

void VegetationScanner::measure(std::int64_t tick) {
  if (!options_.lidar_frame.empty()) sweepLidar(tick);
  viewSky();
}

void VegetationScanner::sweepLidar(std::int64_t tick) {
  const bool wanted = cloud_publisher_.getNumSubscribers() > 0 ||
                      scan_publisher_.getNumSubscribers() > 0 ||
                      report_publisher_.getNumSubscribers() > 0;
  scan::SensorPath path{Pose()};
  if (!findPath(wanted, path)) return;
  announce("", path.at(turn()).position, options_.lidar.beams.range_max);
  if (!wanted) return;
  const ros::WallTime start = ros::WallTime::now();
  sweep(path, tick);
  cost_ = (ros::WallTime::now() - start).toSec();
  ++sweeps_;
}

double VegetationScanner::turn() const {
  return options_.motion == SweepMotion::NONE ? 0.0 : 1.0 / options_.lidar.rate;
}

// A turn ends at the stamp of the tick, so that tf has both of its poses.
bool VegetationScanner::findPath(bool wanted, scan::SensorPath& path) {
  Pose begin, end;
  const Nanoseconds stamp = clock_.stamp();
  if (!findPose(options_.lidar_frame, stamp, wanted, end)) return false;
  path = end;
  if (options_.motion == SweepMotion::NONE) return true;
  if (!findPose(options_.lidar_frame, stamp - fromSeconds(turn()), wanted, begin)) return false;
  path = {begin, end, turn()};
  return true;
}

void VegetationScanner::sweep(const scan::SensorPath& path, std::int64_t tick) {
  const double way = length(path.at(turn()).position - path.begin().position);
  landscape_.update(path.at(turn()).position, options_.lidar.beams.range_max + way, clock_.stamp(),
                    scene_, threads_);
  const auto noiseOf = [&](std::uint64_t sensor) {
    return scan::NoiseKeys{options_.seed, static_cast<std::uint64_t>(tick), sensor};
  };
  if (cloud_publisher_.getNumSubscribers() + report_publisher_.getNumSubscribers() > 0) {
    const scan::Lidar& lidar = options_.lidar;
    const auto returns = scan::sweep(scene_, lidar, path, noiseOf(0), threads_);
    sensor_msgs::PointCloud2 cloud =
        toCloud(returns, lidar, path,
                options_.motion == SweepMotion::RAW ? PointFrame::RAY : PointFrame::BEGIN);
    ScanReport report = toReport(returns, scan::returnsPerRay(lidar.model), scene_);
    cloud.header = report.header = header();
    points_ = cloud.width;
    cloud_publisher_.publish(cloud);
    report_publisher_.publish(report);
  }
  if (scan_publisher_.getNumSubscribers() == 0) return;
  const scan::Lidar plane = scan::planeOf(options_.lidar);
  sensor_msgs::LaserScan scan =
      toScan(scan::sweep(scene_, plane, path, noiseOf(1), threads_), plane.beams, turn());
  scan.header = header();
  scan.scan_time = static_cast<float>(1.0 / options_.lidar.rate);
  scan_publisher_.publish(scan);
}

std_msgs::Header VegetationScanner::header() const {
  std_msgs::Header out;
  out.stamp = toStamp(clock_.stamp() - fromSeconds(turn()));
  out.frame_id = options_.lidar_frame;
  return out;
}

void VegetationScanner::restartScene() {
  SensorBase::restartScene();
  sky_of_frames_.clear();
  sky_of_requests_.clear();
}

void VegetationScanner::reportValues(Status& status) {
  warnOfMore(status, sky_of_frames_.leftOut(), 0,
             "trees and plants left out of views of the sky because of a budget");
  status.add("Sweeps", sweeps_);
  status.add("Sweeps without a place", unplaced_);
  status.add("Points", points_);
  status.add("Wall time of a sweep [ms]", 1e3 * cost_);
  status.add("Views of the sky", views_);
  status.add("Wall time of the views of the sky [ms]", 1e3 * sky_cost_);
}

std::shared_ptr<void> createVegetationScanner(const ros::NodeHandle& handle,
                                              const ros::NodeHandle& private_handle) {
  return std::make_shared<VegetationScanner>(handle, private_handle);
}

}  // namespace vegetation_sim
