// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/sensors/vegetation_scanner.h"

#include "ros/conversions/scan_conversions.h"
#include "ros/services/requests.h"
#include "ros/services/service_replies.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {

VegetationScanner::VegetationScanner(ros::NodeHandle handle, ros::NodeHandle private_handle)
    : handle_(handle),
      private_handle_(private_handle),
      options_(loadScanOptions(private_handle)),
      landscape_({options_.frame_id, true,
                  [this](const std::string& input, const std::string& why) {
                    refusals_.add(input, why);
                  }}),
      tf_buffer_(ros::Duration(tf2::BufferCore::DEFAULT_CACHE_TIME),
                 true),  // with the service that shows its frames
      tf_listener_(tf_buffer_),
      clock_("vegetation_scanner", options_.rate, options_.delay,
             {{},
              [this](std::int64_t tick) { this->tick(tick); },
              [this](Nanoseconds now) { restart(now); }},
             LateTicks::NEWEST),
      diagnostics_(handle, private_handle, private_handle.getNamespace()) {
  restartScene();
  cloud_publisher_ = handle_.advertise<sensor_msgs::PointCloud2>("lidar/points", 10);
  scan_publisher_ = handle_.advertise<sensor_msgs::LaserScan>("lidar/scan", 10);
  report_publisher_ = handle_.advertise<ScanReport>("lidar/report", 10);
  diagnostics_.setHardwareID("none");
  diagnostics_.add("scan", this, &VegetationScanner::diagnose);
  listen();
}

// This is called last: the callbacks of a nodelet may start before its constructor has ended.
void VegetationScanner::listen() {
  landscape_.subscribe(handle_);
  reset_service_ = private_handle_.advertiseService("reset", &VegetationScanner::onReset, this);
  diagnostics_timer_ = handle_.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
  clock_.listen(handle_);
}

void VegetationScanner::tick(std::int64_t tick) {
  landscape_.advance(clock_.stamp());
  const bool wanted = cloud_publisher_.getNumSubscribers() > 0 ||
                      scan_publisher_.getNumSubscribers() > 0 ||
                      report_publisher_.getNumSubscribers() > 0;
  missing_.clear();
  try {
    const Pose sensor =
        poseInWorld(tf_buffer_, options_.frame_id, options_.lidar_frame, toStamp(clock_.stamp()));
    if (!wanted) return;
    const ros::WallTime start = ros::WallTime::now();
    sweep(sensor, tick);
    cost_ = (ros::WallTime::now() - start).toSec();
    ++counts_.sweeps;
  } catch (const InvalidInput&) {
    counts_.unplaced += wanted;
    missing_.add(describeMissingTransform(options_.lidar_frame, options_.frame_id));
  }
}

void VegetationScanner::sweep(const Pose& sensor, std::int64_t tick) {
  landscape_.update(sensor.position, options_.beams.range_max, clock_.stamp(), scene_);
  const auto noiseOf = [&](std::uint64_t sensor) {
    return scan::NoiseKeys{options_.seed, static_cast<std::uint64_t>(tick), sensor};
  };
  if (cloud_publisher_.getNumSubscribers() + report_publisher_.getNumSubscribers() > 0) {
    const auto returns = scan::sweep(scene_, options_.beams, sensor, noiseOf(0), options_.threads);
    sensor_msgs::PointCloud2 cloud = toCloud(returns, options_.beams);
    ScanReport report = toReport(returns, scene_.trees);
    cloud.header = report.header = header();
    points_ = cloud.width;
    cloud_publisher_.publish(cloud);
    report_publisher_.publish(report);
  }
  if (scan_publisher_.getNumSubscribers() == 0) return;
  const scan::Beams plane = scan::planeOf(options_.beams);
  sensor_msgs::LaserScan scan =
      toScan(scan::sweep(scene_, plane, sensor, noiseOf(1), options_.threads), plane);
  scan.header = header();
  scan.scan_time = static_cast<float>(1.0 / options_.rate);
  scan_publisher_.publish(scan);
}

std_msgs::Header VegetationScanner::header() const {
  std_msgs::Header out;
  out.stamp = toStamp(clock_.stamp());
  out.frame_id = options_.lidar_frame;
  return out;
}

void VegetationScanner::restartScene() {
  scene_ = scan::Scene();
  scene_.trees = scan::Trees(static_cast<std::size_t>(options_.branch_budget));
}

void VegetationScanner::restart(Nanoseconds now) {
  landscape_.forgetLater(now);
  restartScene();
  tf_buffer_.clear();
}

bool VegetationScanner::onReset(std_srvs::Trigger::Request&,
                                std_srvs::Trigger::Response& response) {
  return answer(response, [&]() -> std::string {
    restartScene();
    return "trees are grown again at the next sweep";
  });
}

// Reports only what has happened since the last report.
void VegetationScanner::reportProblem(diagnostic_updater::DiagnosticStatusWrapper& status) {
  counts_.clock = clock_.counts();
  refusals_.warn(status);
  warnOfMore(status, counts_.unplaced, reported_.unplaced,
             "sweeps without a transform of the sensor");
  missing_.warn("vegetation_scanner", status);
  counts_.lost = landscape_.lost();
  warnOfMore(status, counts_.lost, reported_.lost,
             "messages lost that are stamped ahead of the clock");
  warnOfClock(status, counts_.clock, reported_.clock);
  warnOfMore(status, scene_.trees.leftOut(), 0, "trees in range left out because of branch_budget");
  if (const std::string why = landscape_.why(); !why.empty())
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, "waiting for a key frame: " + why);
  reported_ = counts_;
}

void VegetationScanner::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  status.summary(DiagnosticStatus::OK, "running");
  if (!clock_.hasBegun()) status.summary(DiagnosticStatus::WARN, "waiting for the clock");
  reportProblem(status);
  status.add("Sweeps", counts_.sweeps);
  status.add("Sweeps without a place", counts_.unplaced);
  status.add("Points", points_);
  status.add("Wall time of a sweep [ms]", 1e3 * cost_);
  status.add("Trees", scene_.trees.all().size());
  status.add("Branches", scene_.trees.branches());
  status.add("Trees left out", scene_.trees.leftOut());
  status.add("People", landscape_.people());
  status.add("Messages ahead of the sweep", landscape_.waiting());
  clock_.report(status);
  status.add("Inputs refused", refusals_.count());
}

}  // namespace vegetation_sim
