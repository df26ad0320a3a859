// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/sensors/vegetation_scanner.h"

#include <algorithm>
#include <optional>
#include <thread>

#include "ros/conversions/scan_conversions.h"
#include "ros/services/requests.h"
#include "ros/services/service_replies.h"
#include "sensors/sweep.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

// How far ahead of the clock an announcement takes effect, so that it arrives before its tick.
constexpr double ANNOUNCED_AHEAD = 0.2;  // [s]

}  // namespace

VegetationScanner::VegetationScanner(const ros::NodeHandle& handle,
                                     const ros::NodeHandle& private_handle)
    : NodeBase("vegetation_scanner", handle, private_handle),
      options_(loadScanOptions(private_handle)),
      landscape_({options_.frame_id, true,
                  [this](const std::string& input, const std::string& why) {
                    refusals_.add(input, why);
                  }}),
      threads_(
          std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, options_.threads)),
      sky_of_frames_(options_, landscape_, threads_,
                     std::max<std::size_t>(options_.sky_frames.size(), 1)),
      sky_of_requests_(options_, landscape_, threads_, 1),
      tf_buffer_(ros::Duration(tf2::BufferCore::DEFAULT_CACHE_TIME),
                 true),  // with the service that shows its frames
      tf_listener_(tf_buffer_),
      clock_(name_, options_.lidar.rate, options_.delay,
             {{},
              [this](std::int64_t tick) { acceptInput("tick", [&] { this->tick(tick); }); },
              [this](Nanoseconds now) { acceptInput("clock", [&] { restart(now); }); }},
             LateTicks::NEWEST) {
  restartScene();
  interest_publisher_ = handle_.advertise<SensorInterest>("forest/sensors", 40);
  cloud_publisher_ = handle_.advertise<sensor_msgs::PointCloud2>("lidar/points", 10);
  scan_publisher_ = handle_.advertise<sensor_msgs::LaserScan>("lidar/scan", 10);
  report_publisher_ = handle_.advertise<ScanReport>("lidar/report", 10);
  sky_publisher_ = handle_.advertise<SkyViews>("sky_view", 10);
  diagnostics_.add("scan", this, &VegetationScanner::diagnose);
  // The callbacks of a nodelet may start from here on.
  landscape_.subscribe(handle_);
  serve("reset", &VegetationScanner::onReset);
  serve("sky_view", &VegetationScanner::onSkyView);
  startDiagnostics();
  clock_.listen(handle_);
}

VegetationScanner::~VegetationScanner() {
  stopCallbacks();
  clock_.stop();
}

void VegetationScanner::tick(std::int64_t tick) {
  openServices();
  landscape_.advance(clock_.stamp());
  missing_.clear();
  measure(tick);
  viewSky();
}

void VegetationScanner::measure(std::int64_t tick) {
  if (options_.lidar_frame.empty()) return;
  const bool wanted = cloud_publisher_.getNumSubscribers() > 0 ||
                      scan_publisher_.getNumSubscribers() > 0 ||
                      report_publisher_.getNumSubscribers() > 0;
  std::optional<scan::SensorPath> path;
  try {
    path = findPath();
  } catch (const InvalidInput&) {
    counts_.unplaced += wanted;
    missing_.add(describeMissingTransform(options_.lidar_frame, options_.frame_id));
    return;
  }
  announce("", path->at(turn()).position, options_.lidar.beams.range_max);
  if (!wanted) return;
  const ros::WallTime start = ros::WallTime::now();
  sweep(*path, tick);
  cost_ = (ros::WallTime::now() - start).toSec();
  ++counts_.sweeps;
}

double VegetationScanner::turn() const {
  return options_.motion == SweepMotion::NONE ? 0.0 : 1.0 / options_.lidar.rate;
}

// A turn ends at the stamp of the tick, so that tf has both of its poses.
scan::SensorPath VegetationScanner::findPath() const {
  const auto poseAt = [&](Nanoseconds stamp) {
    return poseInWorld(tf_buffer_, options_.frame_id, options_.lidar_frame, toStamp(stamp));
  };
  const Pose end = poseAt(clock_.stamp());
  if (options_.motion == SweepMotion::NONE) return end;
  return {poseAt(clock_.stamp() - fromSeconds(turn())), end, turn()};
}

// Announces the sensor whether or not anybody listens to it, so that listening changes nothing.
void VegetationScanner::announce(const std::string& id, const Vec3& place, double range) {
  SensorInterest message =
      toMsg(forest::Sensor{private_handle_.getNamespace() + id, place, range, options_.tolerance,
                           clock_.stamp() + fromSeconds(options_.delay + ANNOUNCED_AHEAD)});
  message.header.frame_id = options_.frame_id;
  interest_publisher_.publish(message);
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
  scene_ = makeScene(options_);
  sky_of_frames_.clear();
  sky_of_requests_.clear();
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
void VegetationScanner::reportProblem(Status& status) {
  counts_.clock = clock_.counts();
  refusals_.warn(status);
  warnOfInterruptions(status);
  warnOfMore(status, counts_.unplaced, reported_.unplaced,
             "sweeps without a transform of the sensor");
  missing_.warn("vegetation_scanner", status);
  counts_.lost = landscape_.lost();
  warnOfMore(status, counts_.lost, reported_.lost,
             "messages lost that are stamped ahead of the clock");
  warnOfClock(status, counts_.clock, reported_.clock);
  warnOfMore(status, scene_.trees.leftOut(), 0, "trees in range left out because of branch_budget");
  warnOfMore(status, scene_.plants.leftOut(), 0, "plants in range left out because of leaf_budget");
  warnOfMore(status, sky_of_frames_.leftOut(), 0,
             "trees and plants left out of views of the sky because of a budget");
  if (const std::string why = landscape_.why(); !why.empty())
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, "waiting for a key frame: " + why);
  if (const std::string rivals = landscape_.rivals(); !rivals.empty())
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN,
                        rivals + ": the last message wins");
  reported_ = counts_;
}

void VegetationScanner::diagnose(Status& status) {
  using diagnostic_msgs::DiagnosticStatus;
  status.summary(DiagnosticStatus::OK, "running");
  if (!clock_.hasBegun()) status.summary(DiagnosticStatus::WARN, "waiting for the clock");
  reportProblem(status);
  status.add("Sweeps", counts_.sweeps);
  status.add("Sweeps without a place", counts_.unplaced);
  status.add("Points", points_);
  status.add("Wall time of a sweep [ms]", 1e3 * cost_);
  status.add("Views of the sky", counts_.views);
  status.add("Wall time of the views of the sky [ms]", 1e3 * sky_cost_);
  status.add("Trees", scene_.trees.all().size());
  status.add("Branches", scene_.trees.branches());
  status.add("Trees left out", scene_.trees.leftOut());
  status.add("Plants", scene_.plants.all().size());
  status.add("Leaves of plants", scene_.plants.leaves());
  status.add("Plants left out", scene_.plants.leftOut());
  status.add("People", landscape_.people());
  status.add("Messages ahead of the sweep", landscape_.waiting());
  clock_.report(status);
  status.add("Inputs refused", refusals_.count());
}

}  // namespace vegetation_sim
