// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "core/threads/thread_pool.h"
#include "sensors/media/light_path.h"
#include "sensors/sensor_scene.h"

namespace vegetation_sim::scan {

/// Bins of the sky, of equal angles, in the world frame. Elevations begin at the horizon, azimuths
/// at x; they are counter-clockwise.
constexpr int SKY_ELEVATIONS = 9, SKY_AZIMUTHS = 24;
constexpr std::size_t SKY_BINS = std::size_t{SKY_ELEVATIONS} * SKY_AZIMUTHS;
/// Rays of each bin.
constexpr int SKY_RAYS = 32;

/// Shares of the light of an evenly bright sky that come to a place.
struct SkyTransmittance {
  std::array<double, SKY_BINS> bins{};  ///< [SKY_ELEVATIONS x SKY_AZIMUTHS] mean of each bin
  double open_share{0.0};               ///< mean of the hemisphere
  double sky_view_factor{0.0};  ///< the same weighted with the cosine to the zenith; 1: open sky
};

/// Range of the elevations of a bin, as sines.
struct SineRange {
  double low, high;
};
SineRange sinesOf(int elevation);
/// Returns a unit vector. @param sine of the elevation. @param azimuth in turns.
Vec3 skyDirection(double sine, double azimuth);

/// Returns the share of light that passes the first `reach` [m] of a ray: 0 if it meets wood, a
/// plant of a canopy, a person or the ground, otherwise what leaves of trees and grass let through.
/// @param dark optical depth from which light counts as blocked.
double transmittance(const Scene& scene, const Ray& ray, double reach,
                     double dark = LightPath::DARK);
/// Returns what comes from the sky, past objects within `reach` [m]. A place below the ground or
/// less than 1 cm above it counts as 1 cm above it. The result does not depend on the number of
/// threads.
SkyTransmittance viewSky(const Scene& scene, const Vec3& place, double reach, ThreadPool& threads);

}  // namespace vegetation_sim::scan
