// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/ground/meadow_texture.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

constexpr int MOST_PIXELS = 2048, MOST_PER_TILE = 32;
constexpr Rgba SOIL{0.33f, 0.27f, 0.18f, 1.f};
constexpr Rgba STUBBLE{0.52f, 0.56f, 0.26f, 1.f}, HAY{0.62f, 0.56f, 0.31f, 1.f};
constexpr double HALF_HIDDEN = 0.12;   // cut grass that hides half of what is below [kg/m^2]
constexpr float UNDER = 0.48f;         // share of light that closed grass blocks
constexpr double THINNING = 0.45;      // share of the grass that is missing in thin places
constexpr double MEADOW_BORDER = 4.0;  // [m] over which the edge fades into the surroundings
constexpr double RAGGED = 0.06;        // part of the map over which the begin of that edge varies

Vec3 widen(const Rgba& c) {
  return {static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
}

// Interpolates tilt [0, 1] and direction between the nodes of a patch.
double crushAt(const grass::CrushPatch& patch, double u, double v, Vec3& lying) {
  const int n = patch.cells;
  const double x = u * n, y = v * n;
  const int c = std::min(static_cast<int>(x), n - 1), r = std::min(static_cast<int>(y), n - 1);
  const double p = x - c, q = y - r;
  const auto at = [&](const std::vector<float>& layer) {
    const float* low = layer.data() + r * (n + 1) + c;
    const float* high = low + n + 1;
    return (double{low[0]} * (1 - p) + double{low[1]} * p) * (1 - q) +
           (double{high[0]} * (1 - p) + double{high[1]} * p) * q;
  };
  lying = Vec3(at(patch.tx), at(patch.ty), 0.0) / grass::BEND_LIMIT;
  return saturate(at(patch.tilt) / grass::BEND_LIMIT);
}

// Returns a share from 0 to 1 that varies within two and ten metres.
double raggedAt(const Noise& noise, float x, float y) {
  const float broad = noise.smooth(x / 9.f + 70.f, y / 9.f),
              fine = noise.smooth(x / 1.7f, y / 1.7f);
  return saturate(1.6 * static_cast<double>(0.7f * broad + 0.3f * fine) - 0.3);
}

}  // namespace

grass::GrassLight grassLight(const Daylight& daylight) {
  grass::GrassLight out;
  out.to_sun = daylight.to_sun;
  out.sun = widen(daylight.sun);
  out.sky = widen(daylight.zenith_light);
  return out;
}

double fullDensity(const grass::FeatureMap& map) {
  double most = 0.0;
  for (int row = 0; row < map.law().rows; ++row)
    for (int column = 0; column < map.law().columns; ++column)
      most = std::max(most, map.node(column, row).density);
  return std::max(most, 1.0);
}

bool isBare(const grass::FeatureMap& map) {
  for (int row = 0; row < map.law().rows; ++row)
    for (int column = 0; column < map.law().columns; ++column)
      if (map.node(column, row).density > 0.0) return false;
  return true;
}

bool isPaintable(const grass::FeatureMap& map) {
  return std::max(map.tileColumns(), map.tileRows()) <= MOST_PIXELS;
}

MeadowPainter::MeadowPainter(const grass::FeatureMap& map, const terrain::HeightMap& terrain,
                             const Daylight& daylight, const Rgba& tint)
    : map_(map),
      terrain_(terrain),
      daylight_(daylight),
      tint_(tint),
      light_(grassLight(daylight)),
      full_(fullDensity(map)),
      per_tile_(1),
      noise_(GROUND_SEED) {
  const int tiles = std::max(map.tileColumns(), map.tileRows());
  while (2 * per_tile_ <= MOST_PER_TILE && 2 * per_tile_ * tiles <= MOST_PIXELS) per_tile_ *= 2;
  edge_ = per_tile_ * tiles;
  plot_ = {map.law().origin_x, map.law().origin_y, map.law().resolution * tiles};
}

MeadowPainter::Ground MeadowPainter::groundAt(const grass::CrushPatch& patch, double x, double y,
                                              double u, double v) const {
  Ground out;
  out.crush = crushAt(patch, u, v, out.lying);
  if (patch.cut.empty()) return out;
  const std::size_t node = patch.nearest(static_cast<float>(u), static_cast<float>(v));
  const double height = map_.at(x, y).height;
  if (height > 0.0) out.cut = saturate(1.0 - double{patch.cut[node]} / height);
  out.swath = double{patch.swath[node]};
  return out;
}

Rgba MeadowPainter::colourAt(double x, double y, const Ground& ground) const {
  const Vec3& lying = ground.lying;
  const grass::MapLaw& law = map_.law();
  const Vec3 normal = terrain_.normal(x, y);
  const Rgba open = openLight(daylight_, normal);
  const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
  const float fine = noise_.fractal(fx / 0.6f, fy / 0.6f, 3) - 0.5f;
  const float patches = noise_.fractal(fx / 4.f + 9.f, fy / 4.f, 2) - 0.5f;
  const auto litter = static_cast<float>(  // dead grass
      smoothStep((static_cast<double>(noise_.smooth(fx / 0.23f, fy / 0.27f)) - 0.45) / 0.3));
  const double east = law.origin_x + law.resolution * map_.tileColumns();
  const double north = law.origin_y + law.resolution * map_.tileRows();
  const double inside =
      std::min(std::min(x - law.origin_x, east - x), std::min(y - law.origin_y, north - y));
  const double range = RAGGED * std::min(east - law.origin_x, north - law.origin_y);
  const double begin = inside < range + MEADOW_BORDER ? range * raggedAt(noise_, fx, fy) : 0.0;
  const auto own_share = static_cast<float>(smoothStep((inside - begin) / MEADOW_BORDER));
  Rgba land{};
  if (own_share < 1.f) {
    land = groundColour(noise_, x, y, 0.0, tint_);
    for (std::size_t i = 0; i < 3; ++i) land[i] *= open[i];
  }
  if (own_share <= 0.f) return land;
  grass::Features f = map_.at(x, y);
  if (!masks_.empty()) f.colour = grass::averageColour(f.colour, masks_, x, y);
  const auto thin = static_cast<float>(
      THINNING *
      smoothStep((static_cast<double>(noise_.fractal(fx / 1.9f + 5.f, fy / 1.9f, 3)) - 0.52) /
                 0.2));
  const auto cover = static_cast<float>(saturate(1.6 * f.density / full_)) * (1.f - thin);
  grass::BladePiece piece;
  const auto down = static_cast<float>(ground.crush);
  piece.flat = 0.12f + 0.7f * down * down;
  piece.way = 0.72f + 0.1f * down;
  // The shine of lodged grass depends on its direction, here for a view along the sunlight.
  piece.away = static_cast<float>(-(lying.x() * light_.to_sun.x() + lying.y() * light_.to_sun.y()));
  const grass::PieceLight light = lightOn(light_, piece);
  const Vec3 own = grass::farColour(map_, f);
  const float lightness = 1.f + 0.5f * fine * (1.f - 0.5f * down) + 0.35f * patches;
  Rgba out;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const float bleached = 1.f + down * (i == 0 ? 0.10f : i == 1 ? 0.02f : 0.0f);
    const float grass = (static_cast<float>(own[k]) * light.factor[i] * bleached + light.shine[i]) *
                        lightness * tint_[i];
    const float soil = mix(SOIL, HAY, 0.5f * litter)[i] * open[i] * (1.f + 0.6f * fine);
    out[i] = soil + (grass - soil) * cover;
  }
  const auto cut = static_cast<float>(ground.cut);
  const auto hay = static_cast<float>(1.0 - 1.0 / (1.0 + ground.swath / HALF_HIDDEN)) *
                   std::min(1.f, std::max(0.f, 1.f + 2.f * fine));
  for (std::size_t i = 0; i < 3; ++i) {
    out[i] += (STUBBLE[i] * open[i] * lightness * tint_[i] - out[i]) * 0.55f * cut * cover;
    out[i] += (HAY[i] * open[i] * lightness * tint_[i] - out[i]) * hay;
  }
  out = mix(land, out, own_share);
  out[3] = 1.f - UNDER * cover * (1.f - 0.55f * down) * (1.f - 0.8f * cut);
  return out;
}

Image MeadowPainter::whole() const {
  Image out(edge_, edge_, {});
  const double pixel = plot_.edge / edge_;
  for (int r = 0; r < edge_; ++r)
    for (int c = 0; c < edge_; ++c)
      out.at(c, edge_ - 1 - r) =
          colourAt(plot_.x + (c + 0.5) * pixel, plot_.y + (r + 0.5) * pixel, Ground());
  return out;
}

Image MeadowPainter::tile(int column, int row, const grass::CrushPatch* patch) const {
  Image out(per_tile_, per_tile_, {});
  const double size = map_.law().resolution;
  for (int r = 0; r < per_tile_; ++r)
    for (int c = 0; c < per_tile_; ++c) {
      const double u = (c + 0.5) / per_tile_, v = (r + 0.5) / per_tile_;
      const double x = plot_.x + (column + u) * size, y = plot_.y + (row + v) * size;
      const Ground ground = patch && patch->cells > 0 ? groundAt(*patch, x, y, u, v) : Ground();
      out.at(c, per_tile_ - 1 - r) = colourAt(x, y, ground);
    }
  return out;
}

}  // namespace vegetation_sim::view
