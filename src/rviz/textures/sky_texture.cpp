// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/textures/sky_texture.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

constexpr double CLOUD_HEIGHT = 1.0;  // of the cloud layer, in units of the noise
constexpr float CLOUD_COVER = 0.53f;  // noise above this value is cloud
constexpr float CLOUD_OPACITY = 0.75f;
constexpr Rgba CLOUD_LIT{1.f, 0.985f, 0.96f, 1.f}, CLOUD_SHADED{0.80f, 0.84f, 0.89f, 1.f};

float smooth(float low, float high, float x) {
  return static_cast<float>(smoothStep((x - low) / (high - low)));
}

// Returns the glow by the cosine of the angle to the sun.
float glow(float towards) {
  const float t2 = towards * towards, t4 = t2 * t2, t8 = t4 * t4;
  return std::min(1.f, 0.55f * t8 * t8 * t8 + 0.25f * t4 * towards);
}

std::vector<SinCos> azimuths(int columns) {
  std::vector<SinCos> out;
  for (int c = 0; c < columns; ++c) out.push_back(sinCos(2.0 * PI * c / columns));
  return out;
}

Vec3 directionOf(const SinCos& azimuth, const SinCos& elevation) {
  return {elevation.cos * azimuth.cos, elevation.cos * azimuth.sin, elevation.sin};
}

float cloudAt(const Noise& noise, const Vec3& direction) {
  // Clouds are a flat layer, so they appear denser towards the horizon.
  const double far = CLOUD_HEIGHT / (direction.z() + 0.09);
  const auto x = static_cast<float>(direction.x() * far),
             y = static_cast<float>(direction.y() * far);
  const float warp = noise.fractal(1.1f * x + 40.f, 1.1f * y, 2);
  return noise.fractal(1.3f * x + warp, 2.0f * y + 0.6f * warp, 5);
}

// Returns the sine of the elevation of far hills by azimuth.
float ridge(const Noise& noise, float turn) {
  const float around = static_cast<float>(Noise::PERIOD) * turn;
  return 0.010f + 0.042f * noise.smooth(0.25f * around, 3.f) * noise.smooth(0.5f * around, 9.f) +
         0.010f * noise.smooth(around, 21.f) + 0.003f * noise.smooth(8.f * around, 40.f);
}

// Returns the sine of the elevation of the tops of far woods by azimuth.
float canopyLine(const Noise& noise, float turn) {
  const float around = static_cast<float>(Noise::PERIOD) * turn;
  return 0.001f + 0.020f * noise.smooth(0.75f * around, 33.f) * noise.smooth(2.f * around, 45.f) +
         0.004f * noise.smooth(4.f * around, 51.f) + 0.002f * noise.smooth(16.f * around, 57.f);
}

// Returns the colour of far woods, whose feet stand in haze.
Rgba woodColour(const Daylight& light, float up) {
  constexpr Rgba DARK{0.60f, 0.70f, 0.66f, 1.f};
  Rgba out = light.horizon;
  for (std::size_t i = 0; i < 3; ++i)
    out[i] *= 1.f + (DARK[i] - 1.f) * 0.62f * smooth(-0.001f, 0.008f, up);
  return out;
}

}  // namespace

double skyElevation(double v) {
  return 0.5 * PI * std::pow(1.0 - v, 1.7);
}

Daylight daylightOf(double azimuth, double elevation) {
  Daylight out;
  const SinCos a = sinCos(azimuth), e = sinCos(elevation);
  out.to_sun = {e.cos * a.cos, e.cos * a.sin, e.sin};
  // Light of a low sun is warmer and weaker, and the haze is stronger.
  const auto low = static_cast<float>(1.0 - smoothStep(elevation / 0.8));
  out.sun = mix(out.sun, {1.38f, 0.93f, 0.52f, 1.f}, low);
  out.horizon = mix(out.horizon, {0.93f, 0.84f, 0.72f, 1.f}, 0.6f * low);
  out.zenith_light = mix(out.zenith_light, {0.46f, 0.50f, 0.62f, 1.f}, low);
  return out;
}

SkyShapes::SkyShapes(int columns_wanted, int rows_wanted)
    : columns(columns_wanted), rows(rows_wanted) {
  const Noise noise(0x5c1);
  const std::vector<SinCos> around = azimuths(columns);
  for (int r = 0; r < rows; ++r) {
    const SinCos e = sinCos(skyElevation((r + 0.5) / rows));
    for (const SinCos& azimuth : around) clouds.push_back(cloudAt(noise, directionOf(azimuth, e)));
  }
  for (int c = 0; c < columns; ++c) {
    const float turn = static_cast<float>(c) / static_cast<float>(columns);
    hills.push_back(ridge(noise, turn));
    woods.push_back(canopyLine(noise, turn));
  }
}

Image skyPicture(const Daylight& light, const SkyShapes& shapes) {
  Image out(shapes.columns, shapes.rows, {});
  const std::vector<SinCos> around = azimuths(out.columns);
  const float* density = shapes.clouds.data();
  for (int r = 0; r < out.rows; ++r) {
    const SinCos e = sinCos(skyElevation((r + 0.5) / out.rows));
    const auto up = static_cast<float>(e.sin);
    const Rgba clear = mix(light.horizon, light.zenith, 1.f - std::pow(1.f - up, 3.2f));
    const Rgba hill = mix(light.horizon, light.zenith, 0.36f * smooth(0.f, 0.04f, up));
    const Rgba wood = woodColour(light, up);
    const float opacity = CLOUD_OPACITY * smooth(0.f, 0.16f, up);
    for (int c = 0; c < out.columns; ++c, ++density) {
      const auto column = static_cast<std::size_t>(c);
      const double towards = std::max(0.0, dot(directionOf(around[column], e), light.to_sun));
      Rgba colour = mix(clear, light.glow, glow(static_cast<float>(towards)));
      const Rgba cloud =
          mix(CLOUD_LIT, CLOUD_SHADED, smooth(CLOUD_COVER + 0.1f, CLOUD_COVER + 0.4f, *density));
      colour = mix(colour, cloud, opacity * smooth(CLOUD_COVER, CLOUD_COVER + 0.24f, *density));
      const float hills = shapes.hills[column];
      const float woods = shapes.woods[column];
      out.at(c, r) = mix(hill, colour, smooth(hills - 0.003f, hills + 0.003f, up));
      out.at(c, r) = mix(wood, out.at(c, r), smooth(woods - 0.001f, woods + 0.001f, up));
      out.at(c, r)[3] = 1.f;
    }
  }
  return out;
}

}  // namespace vegetation_sim::view
