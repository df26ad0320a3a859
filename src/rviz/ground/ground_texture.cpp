// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/ground/ground_texture.h"

#include <algorithm>
#include <cmath>

#include "rviz/ground/shadow_painter.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

constexpr double ROOM = 14.0;         // [m] margin around the trees
constexpr double LAND_BORDER = 0.12;  // share of the edge that fades to plain grass
constexpr Rgba GRASS_DEEP{0.24f, 0.28f, 0.13f, 1.f}, GRASS_FRESH{0.35f, 0.39f, 0.19f, 1.f};
constexpr Rgba GRASS_DRY{0.46f, 0.43f, 0.27f, 1.f};
constexpr Rgba HERBS{0.23f, 0.31f, 0.15f, 1.f}, BARE{0.39f, 0.34f, 0.26f, 1.f};
constexpr Rgba LITTER{0.30f, 0.25f, 0.175f, 1.f}, MOSS{0.22f, 0.25f, 0.13f, 1.f};
constexpr Rgba HUMUS{0.20f, 0.165f, 0.12f, 1.f};
constexpr Rgba OCHRE_LEAF{0.46f, 0.36f, 0.22f, 1.f}, PALE_LEAF{0.52f, 0.45f, 0.32f, 1.f};
constexpr float RELIEF = 0.30f;      // height of hummocks [m], of which only the light is drawn
constexpr double SLOPE_STEP = 0.08;  // [m] over which their slope is measured

float ramp(double low, double high, double x) {
  return static_cast<float>(smoothStep((x - low) / (high - low)));
}

Rgba times(const Rgba& a, const Rgba& b) {
  return {a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]};
}

}  // namespace

Plot plotAround(const Extent& extent) {
  const Vec3 size = extent.high - extent.low;
  Plot out;
  out.edge = std::max(40.0, std::max(size.x(), size.y()) + 2.0 * ROOM) / (1.0 - 2.0 * LAND_BORDER);
  out.x = 0.5 * (extent.low.x() + extent.high.x() - out.edge);
  out.y = 0.5 * (extent.low.y() + extent.high.y() - out.edge);
  return out;
}

Window windowAround(const Plot& plot, int edge, const Extent& extent) {
  constexpr int STEP = 32;  // pixels of which five mipmaps make one
  const auto below = [&](double x) {
    return std::clamp(static_cast<int>(std::floor(x / plot.edge * edge / STEP)) * STEP, 0, edge);
  };
  const auto above = [&](double x) {
    return std::clamp(static_cast<int>(std::ceil(x / plot.edge * edge / STEP)) * STEP, 0, edge);
  };
  const int column = below(extent.low.x() - plot.x), row = below(extent.low.y() - plot.y);
  return {column, row, above(extent.high.x() - plot.x) - column,
          above(extent.high.y() - plot.y) - row};
}

namespace {

// Returns the colour of grass with herbs, dry places and tufts.
Rgba grassColour(const Noise& noise, float x, float y, float fine) {
  const float broad = noise.fractal(x / 23.f, y / 23.f, 3);
  Rgba out = mix(GRASS_DEEP, GRASS_FRESH, ramp(0.3, 0.7, broad));
  out = mix(out, GRASS_DRY, 0.6f * ramp(0.52, 0.85, noise.fractal(x / 11.f, y / 11.f + 30.f, 3)));
  const float ragged = 0.3f * (noise.smooth(x / 0.37f + 9.f, y / 0.37f) - 0.5f);
  const float herbs = noise.fractal(x / 3.7f + 21.f, y / 3.7f, 3) + ragged;
  out = mix(out, HERBS, 0.7f * ramp(0.54, 0.68, herbs));
  out = mix(out, times(out, {0.74f, 0.80f, 0.66f, 1.f}), ramp(0.4, 0.7, fine));
  const float tufts = 0.7f + 0.6f * noise.fractal(x / 0.7f, y / 0.7f + 3.f, 2);
  return times(out, {tufts, tufts, tufts, 1.f});
}

// Returns the colour of humus and moss with fallen leaves on them.
Rgba floorColour(const Noise& noise, float x, float y) {
  const float ragged = 0.35f * (noise.fractal(x / 0.45f + 3.f, y / 0.45f, 2) - 0.5f);
  const float patches = noise.fractal(x / 5.f, y / 5.f + 11.f, 4) + ragged;
  Rgba out = mix(LITTER, MOSS, ramp(0.46, 0.66, patches));
  out = mix(out, HUMUS, 0.8f * ramp(0.55, 0.35, noise.fractal(x / 1.7f + 40.f, y / 1.7f, 3)));
  const Rgba leaf = mix(OCHRE_LEAF, PALE_LEAF, ramp(0.3, 0.7, noise.smooth(x / 0.31f, y / 0.29f)));
  const float lying = ramp(0.55, 0.75, noise.smooth(x / 0.17f + 5.f, y / 0.17f));
  const float many = ramp(0.72, 0.38, noise.fractal(x / 4.3f, y / 4.3f + 50.f, 3));
  return mix(out, leaf, 0.75f * lying * many);
}

// Returns the normal of ground with hummocks.
Vec3 roughNormal(const Noise& noise, double x, double y, const Vec3& normal) {
  const auto height = [&](double px, double py) {
    return static_cast<double>(RELIEF * noise.fractal(static_cast<float>(px) / 3.1f + 13.f,
                                                      static_cast<float>(py) / 3.1f, 4));
  };
  const double here = height(x, y);
  const Vec3 out = normal - Vec3((height(x + SLOPE_STEP, y) - here) / SLOPE_STEP,
                                 (height(x, y + SLOPE_STEP) - here) / SLOPE_STEP, 0.0);
  return out / length(out);
}

}  // namespace

Rgba groundColour(const Noise& noise, double x, double y, double shelter, const Rgba& tint) {
  const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
  const float fine = noise.fractal(fx / 2.3f + 7.f, fy / 2.3f, 3);
  const float ragged = 0.25f * (noise.fractal(fx / 0.5f, fy / 0.5f + 17.f, 2) - 0.5f);
  const float bare = ramp(0.60, 0.74, noise.fractal(fx / 6.1f + 50.f, fy / 6.1f + 8.f, 4) + ragged);
  Rgba out = times(grassColour(noise, fx, fy, fine), tint);
  out = mix(out, times(BARE, {0.8f + 0.4f * fine, 0.8f + 0.4f * fine, 0.8f + 0.4f * fine, 1.f}),
            0.8f * bare);
  const double edge = shelter + 0.5 * (static_cast<double>(fine) - 0.5);
  const float covered = 0.95f * ramp(0.15, 0.5, edge);
  return covered > 0.f ? mix(out, floorColour(noise, fx, fy), covered) : out;
}

Rgba openLight(const Daylight& daylight, const Vec3& normal) {
  const auto facing = static_cast<float>(std::max(0.0, dot(normal, daylight.to_sun)));
  Rgba out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = daylight.sun[i] * facing + daylight.zenith_light[i];
  out[3] = 1.f;
  return out;
}

Image groundPicture(const Plot& plot, int edge, const TreeSet& tree_set,
                    const terrain::HeightMap& terrain, const Daylight& daylight, const Rgba& tint) {
  const Shade shade{shadowsOn(plot, edge, tree_set, terrain, daylight.to_sun),
                    [&](const Vec3& at) { return tree_set.light().sky(at); }};
  return groundPicture(plot, edge, wholePlot(edge), shade, terrain, daylight, tint);
}

Image groundPicture(const Plot& plot, int edge, const Window& window, const Shade& shade,
                    const terrain::HeightMap& terrain, const Daylight& daylight, const Rgba& tint) {
  const Noise noise(GROUND_SEED);
  Image out(window.columns, window.rows, {});
  for (int i = 0; i < window.rows; ++i) {
    for (int j = 0; j < window.columns; ++j) {
      const int r = window.row + i, c = window.column + j;
      const double u = (c + 0.5) / edge, v = (r + 0.5) / edge;
      const double x = plot.x + plot.edge * u, y = plot.y + plot.edge * v;
      const double from_border = std::min(std::min(u, 1.0 - u), std::min(v, 1.0 - v));
      const auto inside = static_cast<double>(ramp(0.2 * LAND_BORDER, LAND_BORDER, from_border));
      const Vec3 at(x, y, terrain.height(x, y) + 0.3);
      const double sky = shade.sky ? 1.0 - inside * (1.0 - shade.sky(at)) : 1.0;
      const double lit =
          shade.sun.empty()
              ? 1.0
              : static_cast<double>(shade.sun[static_cast<std::size_t>(i * window.columns + j)]);
      const auto sun = static_cast<float>(1.0 - inside * (1.0 - lit));
      const Vec3 normal = roughNormal(noise, x, y, terrain.normal(x, y));
      const auto facing = static_cast<float>(std::max(0.0, dot(normal, daylight.to_sun)));
      const Rgba colour = groundColour(noise, x, y, 1.0 - sky, tint);
      Rgba& pixel = out.at(j, window.rows - 1 - i);
      for (std::size_t k = 0; k < 3; ++k)
        pixel[k] = colour[k] * (daylight.sun[k] * facing * sun +
                                daylight.zenith_light[k] * static_cast<float>(0.25 + 0.75 * sky));
      pixel[3] = 1.f;
    }
  }
  return out;
}

}  // namespace vegetation_sim::view
