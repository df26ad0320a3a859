// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2_ros/buffer.h>
#include <vegetation_sim/GetSkyView.h>
#include <vegetation_sim/SkyViews.h>

#include <string>
#include <vector>

#include "nodes/base/node_base.h"
#include "nodes/sensors/scanner_options.h"
#include "nodes/sensors/sky_viewer.h"
#include "ros/replicas/landscape_replica.h"
#include "ros/services/frame_listener.h"
#include "ros/services/missing_inputs.h"
#include "ros/time/tick_clock.h"
#include "sensors/model/sensor_path.h"

namespace vegetation_sim {

/// Simulates a lidar at a tf frame, and views of the sky at others. At each tick it brings its
/// replicas of the landscape to the stamp, casts the rays and publishes their returns. One thread
/// calls everything.
class VegetationScanner final : public NodeBase {
 public:
  /// @throws InvalidInput for invalid parameters.
  VegetationScanner(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
  ~VegetationScanner() override;

 private:
  void tick(std::int64_t tick);
  scan::SensorPath findPath() const;
  void measure(std::int64_t tick);
  /// @param id follows the name of the node. @param range of the sensor [m].
  void announce(const std::string& id, const Vec3& place, double range);
  void sweep(const scan::SensorPath& path, std::int64_t tick);
  void restartScene();
  void restart(Nanoseconds now);
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  /// Publishes what each frame of `sky_frames` sees.
  void viewSky();
  bool onSkyView(GetSkyView::Request& request, GetSkyView::Response& response);
  std::vector<Vec3> placesOf(const GetSkyView::Request& request) const;
  /// Returns the origin of a frame at the stamp of the tick. @throws InvalidInput
  Vec3 placeOf(const std::string& frame) const;
  std_msgs::Header skyHeader() const;
  void reportProblem(Status& status);
  void diagnose(Status& status);
  /// Duration of a full turn of a sensor that moves within a sweep [s]; 0: all rays have the same
  /// instant.
  double turn() const;
  /// Header of the current sweep.
  std_msgs::Header header() const;

  ScanOptions options_;
  LandscapeReplica landscape_;
  scan::Scene scene_;
  ThreadPool threads_;
  SkyViewer sky_of_frames_, sky_of_requests_;
  struct Counts {
    std::uint64_t sweeps{0}, unplaced{0}, lost{0}, views{0};
    TickClock::Counts clock;
  } counts_, reported_;  // so far, and when diagnostics were last sent
  MissingInputs missing_;
  double cost_{0.0};         // wall time of the last sweep [s]
  double sky_cost_{0.0};     // wall time of the last views of all frames [s]
  std::uint32_t points_{0};  // of the last sweep

  tf2_ros::Buffer tf_buffer_;
  FrameListener tf_listener_;
  ros::Publisher interest_publisher_, cloud_publisher_, scan_publisher_, report_publisher_,
      sky_publisher_;
  TickClock clock_;
};

}  // namespace vegetation_sim
