// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <vegetation_sim/ScanReport.h>

#include <vector>

#include "sensors/sweep.h"

namespace vegetation_sim {

/// One point of a cloud, as its bytes are. Fields of the cloud have these names and the types that
/// PCL has for them; `branch` is -1 where there is none.
struct ScanPoint {
  float x{0.f}, y{0.f}, z{0.f}, intensity{0.f};  ///< sensor's frame [m]; share of the light
  std::uint32_t label{0};                        ///< ScanReport
  std::uint32_t plant{0};                        ///< id of the tree or walker
  std::int32_t branch{0};                        ///< of the tree; limb of the walker
  float time{0.f};                               ///< after the stamp of the cloud [s]
  std::uint16_t ring{0};                         ///< 0 is the lowest
  std::uint16_t unused{0};
};
static_assert(sizeof(ScanPoint) == 36, "no gaps");

/// The rays that have a point, ring by ring. Left to the caller: the header.
sensor_msgs::PointCloud2 toCloud(const std::vector<scan::Return>& returns,
                                 const scan::Beams& beams);
/// Ranges as REP 117 has them. Requires the one ring of scan::planeOf(). Left to the caller: the
/// header and times.
sensor_msgs::LaserScan toScan(const std::vector<scan::Return>& returns, const scan::Beams& beams);
ScanReport toReport(const std::vector<scan::Return>& returns, const scan::Trees& trees);

}  // namespace vegetation_sim
