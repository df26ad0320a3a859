// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <vegetation_sim/ScanReport.h>
#include <vegetation_sim/SkyView.h>

#include <vector>

#include "sensors/sky_view.h"
#include "sensors/sweep.h"

namespace vegetation_sim {

/// One point of a cloud, as its bytes are. Fields of the cloud have these names and the types that
/// PCL has for them; `branch` is -1 where there is none.
struct ScanPoint {
  float x{0.f}, y{0.f}, z{0.f}, intensity{0.f};  ///< sensor's frame [m]; share of the light
  std::uint32_t label{0};                        ///< ScanReport
  std::uint32_t plant{0};                        ///< id of the tree, walker or plant
  std::int32_t branch{0};                        ///< of the tree; limb, leaf or stem
  float time{0.f};                               ///< after the stamp of the cloud [s]
  std::uint16_t ring{0};                         ///< 0 is the lowest
  std::uint8_t return_type{0};                   ///< scan::ReturnType
  std::uint8_t unused{0};
};
static_assert(sizeof(ScanPoint) == 36, "no gaps");

/// Frames of the points of a sensor that moves: its frame at the beginning of the sweep, or that at
/// the instant of each ray.
enum class PointFrame { BEGIN, RAY };

/// The returns that are points, ring by ring. Left to the caller: the header.
sensor_msgs::PointCloud2 toCloud(const std::vector<scan::Return>& returns, const scan::Lidar& lidar,
                                 const scan::SensorPath& path, PointFrame frame);
/// Ranges as REP 117 has them, each as the sensor measures it. Requires the one ring of
/// scan::planeOf(). @param turn duration of a full turn [s]; 0: one instant. Left to the caller:
/// the header and scan_time.
sensor_msgs::LaserScan toScan(const std::vector<scan::Return>& returns, const scan::Beams& beams,
                              double turn);
/// @param per_ray returns of each ray.
ScanReport toReport(const std::vector<scan::Return>& returns, int per_ray,
                    const scan::Scene& scene);

/// Left to the caller: the name of the frame.
SkyView toSkyView(const scan::SkyTransmittance& sky, const Vec3& place, const scan::Scene& scene);

}  // namespace vegetation_sim
