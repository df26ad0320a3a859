// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/GetSkyView.h>
#include <vegetation_sim/SkyViews.h>

#include <string>
#include <vector>

#include "nodes/sensors/scanner_options.h"
#include "nodes/sensors/sensor_base.h"
#include "nodes/sensors/sky_viewer.h"
#include "sensors/model/sensor_path.h"

namespace vegetation_sim {

/// Simulates a lidar at a tf frame, and views of the sky at others.
class VegetationScanner final : public SensorBase {
 public:
  /// @throws InvalidInput for invalid parameters.
  VegetationScanner(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
  ~VegetationScanner() override;

 private:
  VegetationScanner(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                    const ScanOptions& options);
  void measure(std::int64_t tick) override;
  void reportValues(Status& status) override;
  void restartScene() override;
  bool findPath(bool wanted, scan::SensorPath& path);
  void sweepLidar(std::int64_t tick);
  void sweep(const scan::SensorPath& path, std::int64_t tick);
  /// Publishes what each frame of `sky_frames` sees.
  void viewSky();
  bool onSkyView(GetSkyView::Request& request, GetSkyView::Response& response);
  std::vector<Vec3> placesOf(const GetSkyView::Request& request) const;
  /// Returns the origin of a frame at the stamp of the tick. @throws InvalidInput
  Vec3 placeOf(const std::string& frame) const;
  std_msgs::Header skyHeader() const;
  /// Duration of a full turn of a sensor that moves within a sweep [s]; 0: all rays have the same
  /// instant.
  double turn() const;
  /// Header of the current sweep.
  std_msgs::Header header() const;

  const ScanOptions options_;
  SkyViewer sky_of_frames_, sky_of_requests_;
  std::uint64_t sweeps_{0}, views_{0};
  double cost_{0.0};         // wall time of the last sweep [s]
  double sky_cost_{0.0};     // wall time of the last views of all frames [s]
  std::uint32_t points_{0};  // of the last sweep
  ros::Publisher cloud_publisher_, scan_publisher_, report_publisher_, sky_publisher_;
};

}  // namespace vegetation_sim
