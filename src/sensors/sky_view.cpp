// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/sky_view.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scan {
namespace {

constexpr double CLEARANCE = 0.01;  // of a place from the ground [m]

// Hammersley's points (1960): sines are equally spaced in a bin, and so are azimuths, so that
// upright and level edges are sampled evenly.
struct SkySample {
  double sine, azimuth;  // shares of the bin
};
SkySample sampleOf(int ray) {
  double azimuth = 0.5 / SKY_RAYS;
  for (int bit = 1; bit < SKY_RAYS; bit *= 2)
    if ((ray & bit) != 0) azimuth += 0.5 / bit;
  return {(ray + 0.5) / SKY_RAYS, azimuth};
}

// Sums over the rays of a bin.
struct BinSum {
  double light{0.0};     // of transmittances
  double vertical{0.0};  // of transmittances times cosines to the zenith
};

BinSum sumBin(const Scene& scene, const Vec3& place, double reach, int elevation, int azimuth) {
  const SineRange sines = sinesOf(elevation);
  BinSum out;
  for (int ray = 0; ray < SKY_RAYS; ++ray) {
    const SkySample sample = sampleOf(ray);
    const double sine = sines.low + sample.sine * (sines.high - sines.low);
    const Vec3 direction = skyDirection(sine, (azimuth + sample.azimuth) / SKY_AZIMUTHS);
    const double light = transmittance(scene, Ray(place, direction), reach);
    out.light += light;
    out.vertical += light * sine;
  }
  return out;
}

}  // namespace

SineRange sinesOf(int elevation) {
  const double turns = 0.25 / SKY_ELEVATIONS;
  return {sinCosTurns(elevation * turns).sin, sinCosTurns((elevation + 1) * turns).sin};
}

Vec3 skyDirection(double sine, double azimuth) {
  const SinCos around = sinCosTurns(azimuth);
  const double cosine = std::sqrt(std::max(0.0, 1.0 - sine * sine));
  return {cosine * around.cos, cosine * around.sin, sine};
}

double transmittance(const Scene& scene, const Ray& ray, double reach, double dark) {
  Hit solid = castToGround(scene, ray, reach);
  if (solid.label != Label::NONE) return 0.0;
  const FloatRay narrow(ray);
  scene.people.meet(ray, narrow, solid);
  scene.plants.meet(ray, narrow, solid);
  scene.crowns.meet(ray, narrow, solid);
  if (solid.label != Label::NONE) return 0.0;
  LightPath path(reach, dark);
  scene.trees.addDepth(ray, narrow, path);
  scene.grass.addDepth(ray, path);
  return path.transmittance();
}

SkyTransmittance viewSky(const Scene& scene, const Vec3& place, double reach, ThreadPool& threads) {
  Vec3 from = place;
  from.z() = std::max(from.z(), scene.ground->height(from.x(), from.y()) + CLEARANCE);
  std::array<BinSum, SKY_BINS> sums;
  const std::size_t stride = threads.size();
  threads.run(stride, [&](std::size_t first) {
    for (std::size_t bin = first; bin < SKY_BINS; bin += stride) {
      const auto elevation = static_cast<int>(bin / SKY_AZIMUTHS);
      sums[bin] = sumBin(scene, from, reach, elevation, static_cast<int>(bin % SKY_AZIMUTHS));
    }
  });
  SkyTransmittance out;
  for (std::size_t bin = 0; bin < SKY_BINS; ++bin) {
    const SineRange sines = sinesOf(static_cast<int>(bin / SKY_AZIMUTHS));
    const double part = (sines.high - sines.low) / (SKY_AZIMUTHS * SKY_RAYS);
    out.bins[bin] = sums[bin].light / SKY_RAYS;
    out.open_share += part * sums[bin].light;
    out.sky_view_factor += 2.0 * part * sums[bin].vertical;
  }
  return out;
}

}  // namespace vegetation_sim::scan
