// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/threads/thread_pool.h"
#include "sensors/sensor_scene.h"
#include "vegetation_sim/core/config/fields.h"
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
  double noise{0.01};            ///< standard deviation of ranges [m]
};
void describe(FieldVisitor& visitor, Beams& beams);
/// Adds a fault for each range whose ends are not in order.
void check(const Beams& beams, const std::string& context, Faults& faults);

/// Returns the unit vector of a ray in the sensor's frame.
Vec3 directionOf(const Beams& beams, int ring, int column);
/// Returns a planar scan with the same columns.
Beams planeOf(const Beams& beams);

/// One measurement.
struct Return {
  /// Range with noise [m]; infinite: nothing within range_max; -infinite: too near.
  double range{0.0};
  Hit hit;
  bool isPoint() const { return range > 0.0 && range < std::numeric_limits<double>::infinity(); }
};

/// Keys of the noise: a different number for each ray of each sweep of each sensor, independent of
/// order and process.
struct NoiseKeys {
  std::uint64_t seed{0}, sweep{0}, sensor{0};
};
/// Returns the error of a range over its standard deviation: mean 0, variance 1, the sum of twelve
/// uniform numbers (Irwin 1927, Hall 1927), never beyond 6.
double unitNoise(const NoiseKeys& noise, std::uint64_t ray);

/// Casts all rays at one instant. [rings x columns] The result does not depend on the number of
/// threads.
std::vector<Return> sweep(const Scene& scene, const Beams& beams, const Pose& sensor,
                          const NoiseKeys& noise, ThreadPool& threads);

/// Counts points by label, and rays without a point under NONE; the sum is the number of rays.
std::array<std::uint32_t, LABELS> countLabels(const std::vector<Return>& returns);

/// Returns the approximate share of reflected light at 905 nm for dry soil, bark, leaves, grass and
/// clothes, times the cosine of incidence.
double intensityOf(const Hit& hit);

}  // namespace vegetation_sim::scan
