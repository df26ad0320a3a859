// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/camera/daylight.h"

#include <algorithm>
#include <cmath>

#include "sensors/camera/texture.h"
#include "sensors/model/weather.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scan {
namespace {

// Optical depths of the air above, so that a low sun is red.
const Vec3 SUN_DEPTH(0.10, 0.15, 0.26);
constexpr double SUN_STRENGTH = 3.0;
const Vec3 ZENITH(0.055, 0.165, 0.50), HORIZON(0.56, 0.68, 0.80), CLOUD(0.95, 0.96, 0.98);
const Vec3 SKY_LIGHT(0.42, 0.55, 0.78), GROUND_LIGHT(0.13, 0.13, 0.075);
constexpr double CLOUD_HEIGHT = 6.0;  // scale of the clouds
constexpr double HILLS = 0.035;       // elevation of far hills
const Vec3 HILL(0.34, 0.44, 0.47), FAR_HILL(0.43, 0.54, 0.62);
constexpr std::uint32_t HILL_KEY = 0x68696c6cU;
constexpr std::uint32_t CLOUD_KEY = 0x636c6f75U;

Vec3 mixed(const Vec3& a, const Vec3& b, double share) {
  return a + share * (b - a);
}

}  // namespace

void describe(FieldVisitor& v, Weatherlight& l) {
  v.number("sun_azimuth", l.sun_azimuth, "rad", {-6.2832, 6.2832});
  v.number("sun_elevation", l.sun_elevation, "rad", {0.0, 1.5707});
  v.number("fog_visibility", l.fog_visibility, "m", {0.0, 100000.0});
}

Daylight::Daylight(const Weatherlight& light) : extinction_(fogExtinction(light.fog_visibility)) {
  const SinCos azimuth = sinCos(light.sun_azimuth), elevation = sinCos(light.sun_elevation);
  to_sun_ = {elevation.cos * azimuth.cos, elevation.cos * azimuth.sin, elevation.sin};
  for (int i = 0; i < 3; ++i)
    sun_[i] = SUN_STRENGTH * std::exp(-SUN_DEPTH[i] / std::max(elevation.sin, 0.03));
}

Vec3 Daylight::ambient(double up, double sky) const {
  return sky * mixed(GROUND_LIGHT, SKY_LIGHT, 0.5 + 0.5 * up);
}

Vec3 Daylight::skyTowards(const Vec3& direction) const {
  const double up = std::max(direction.z(), 0.0);
  const Vec3 level(direction.x(), direction.y(), 0.0);
  for (std::uint32_t ridge = up < HILLS ? 0 : 2; ridge < 2; ++ridge)
    if (up <
        HILLS * (0.6 + 0.4 * ridge) * fractalNoise((3.0 + ridge) * level, 4, HILL_KEY + 8 * ridge))
      return ridge == 0 ? HILL : FAR_HILL;
  Vec3 out = mixed(ZENITH, HORIZON, std::pow(1.0 - up, 3.0));
  const double to_sun = std::max(dot(direction, to_sun_), 0.0);
  const double glow = 0.25 * std::pow(to_sun, 10.0) + 0.6 * std::pow(to_sun, 120.0) +
                      20.0 * smoothStep((to_sun - 0.9998) / 0.0001);
  const Vec3 plane = CLOUD_HEIGHT / (up + 0.15) * level;
  const double cloud = smoothStep((fractalNoise(0.35 * plane, 5, CLOUD_KEY) - 0.47) / 0.30);
  out = mixed(out, CLOUD, 0.85 * cloud * smoothStep(up / 0.25));
  return out + glow * (1.0 - 0.6 * cloud) * sun_ / SUN_STRENGTH;
}

Vec3 Daylight::through(const Vec3& radiance, double distance) const {
  return mixed(HORIZON, radiance, std::exp(-extinction_ * distance));
}

}  // namespace vegetation_sim::scan
