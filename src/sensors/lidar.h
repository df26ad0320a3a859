// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sensors/model/sensor_model.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scan {

/// Rays of a lidar: rings of equal elevation and columns of equal azimuth, in the sensor's frame (x
/// forward, y left, z up). The upper limit of the elevations has a ring; that of the azimuths has
/// no column, since a full turn comes back to the first.
struct Beams {
  int rings{16};
  double elevation_low{-0.2618};  ///< [rad]
  double elevation_high{0.2618};  ///< [rad]
  int columns{900};
  double azimuth_low{-3.14159};  ///< [rad]
  double azimuth_high{3.14159};  ///< [rad]
  double range_min{0.3};         ///< Nearer objects give no return [m].
  double range_max{60.0};        ///< [m]
};
void describe(FieldVisitor& visitor, Beams& beams);
/// Adds a fault for each range whose ends are not in order.
void check(const Beams& beams, const std::string& context, Faults& faults);

/// A lidar.
struct Lidar {
  Beams beams;
  SensorModel model;
  int rate{10};  ///< sweeps, and turns of a sensor that moves within a sweep [Hz]
};
void describe(FieldVisitor& visitor, Lidar& lidar);
/// Adds the faults of beams and model.
void check(const Lidar& lidar, const std::string& context, Faults& faults);

/// Returns the unit vector of a ray in the sensor's frame.
Vec3 directionOf(const Beams& beams, int ring, int column);
/// The same vectors for all rays, with one angle computed for each ring and column.
class BeamDirections {
 public:
  explicit BeamDirections(const Beams& beams);
  Vec3 at(int ring, int column) const;

 private:
  std::vector<SinCos> rings_, columns_;
};
/// Numbers of adjoining rings and columns.
struct BeamTile {
  int rings, columns;
};
/// Returns the shape of at most RayBundle::MOST_RAYS neighbouring beams that spread equally in both
/// directions. A tile at an end may have fewer.
BeamTile tileOf(const Beams& beams);
/// Returns when a column is measured, after the beginning of a sweep [s]. The sensor turns
/// counter-clockwise from azimuth_low. @param turn duration of a full turn [s].
double timeOf(const Beams& beams, int column, double turn);
/// Returns a planar scan with the same columns and one return for each.
Lidar planeOf(const Lidar& lidar);

}  // namespace vegetation_sim::scan
