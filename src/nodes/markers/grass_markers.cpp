// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/markers/grass_markers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ros/services/allocation_report.h"

namespace vegetation_sim {
namespace {

constexpr double EYE_HEIGHT = 20.0;  // [m] of the default viewer

std_msgs::ColorRGBA colourOf(const std::uint8_t* rgb, std::uint8_t alpha) {
  constexpr float BYTE = 255.f;
  std_msgs::ColorRGBA out;
  out.r = rgb[0] / BYTE;
  out.g = rgb[1] / BYTE;
  out.b = rgb[2] / BYTE;
  out.a = alpha / BYTE;
  return out;
}

double largestDensity(const grass::FeatureMap& map) {
  double out = 1.0;
  for (int row = 0; row < map.law().rows; ++row)
    for (int column = 0; column < map.law().columns; ++column)
      out = std::max(out, map.node(column, row).density);
  return out;
}

Viewpoint eyeAbove(const grass::MeadowLod& meadow) {
  const grass::MapLaw& law = meadow.map().law();
  const double x = law.origin_x + 0.5 * law.resolution * (law.columns - 1);
  const double y = law.origin_y + 0.5 * law.resolution * (law.rows - 1);
  return {Vec3(x, y, meadow.terrain().height(x, y) + EYE_HEIGHT)};
}

}  // namespace

GrassMarkers::GrassMarkers(const grass::TreadSimulation& field,
                           std::shared_ptr<const terrain::HeightMap> terrain,
                           const wind::Field& wind, const grass::ColourMasks& colours,
                           const grass::MeadowSettings& settings, int points)
    : field_(field),
      wind_(wind),
      colours_(colours),
      settings_(settings),
      meadow_(field.layout().map, std::move(terrain), field.layout().seed, settings),
      list_points_(static_cast<std::size_t>(points) / 9 * 3) {
  for (const char* ns : {"ground", "strips", "blades"})
    lists_.addList(ns, list_points_, TriangleLists::Padding::FIRST_POINT);
}

void GrassMarkers::setSettings(const grass::MeadowSettings& settings) {
  meadow_.setSettings(settings);
  settings_ = settings;
}

BalanceTerms GrassMarkers::balanceTerms() const {
  return {"Tiles",  settings_.tolerance,   "marker_points",
          "blades", settings_.most_blades, {"of texture", "of strips", "of blades"}};
}

// Adds the whole map in squares as small as the budget allows.
void GrassMarkers::addGround() {
  const grass::FeatureMap& map = meadow_.map();
  const std::uint64_t wanted = map.hash() ^ meadow_.terrain().hash();
  if (ground_of_ == wanted) return;
  ground_of_ = wanted;
  full_density_ = largestDensity(map);
  const grass::MapLaw& law = map.law();
  int step = 1;
  const auto cells = [&](int nodes) { return (nodes - 1 + step - 1) / step; };
  while (6.0 * cells(law.columns) * cells(law.rows) > static_cast<double>(list_points_)) ++step;
  const std::vector<std::uint8_t> colours = grass::groundColours(map, full_density_);
  const auto add = [&](int column, int row) {
    const int c = std::min(column, law.columns - 1), r = std::min(row, law.rows - 1);
    const double x = law.origin_x + c * law.resolution, y = law.origin_y + r * law.resolution;
    const std::uint8_t* rgb = &colours[3 * (static_cast<std::size_t>(r) * law.columns + c)];
    lists_.add(GROUND, Vec3(x, y, meadow_.terrain().height(x, y)), colourOf(rgb, 255));
  };
  lists_.clear(GROUND);
  for (int row = 0; row < law.rows - 1; row += step)
    for (int column = 0; column < law.columns - 1; column += step)
      for (const auto& [c, r] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}})
        add(column + c * step, row + r * step);
}

void GrassMarkers::addTile(const grass::TileView& view, const grass::Tile& tile,
                           const grass::TileMotion& motion, const Vec3& eye) {
  if (view.morph.strip > 0.0 && strip_mesh_.indices.size() < list_points_)
    grass::appendStrips(meadow_.map(), tile, motion, view.morph.strip, full_density_, strip_mesh_);
  if (!view.morph.blades || blade_mesh_.indices.size() >= list_points_) return;
  const int count = static_cast<int>(view.share * tile.blades);
  blocks_.resize(static_cast<std::size_t>(grass::blocksFor(count)));
  grass::poseBlades(tile, motion, count, blocks_.data());
  grass::RibbonStyle style;
  style.segments = view.segments;
  style.width = 1.0 / std::max(view.share, 1e-3);
  style.slide = view.morph.slide;
  style.eye = eye;
  grass::appendRibbons(meadow_.map(), tile, blocks_.data(), count, style, blade_mesh_);
}

void GrassMarkers::copy(const grass::GrassMesh& mesh, std::size_t list) {
  lists_.clear(list);
  const std::size_t count = std::min(mesh.indices.size(), list_points_);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t vertex = mesh.indices[i];
    const float* p = &mesh.positions[3 * vertex];
    const std::uint8_t* rgba = &mesh.colours[4 * vertex];
    lists_.add(list, mesh.origin + Vec3(p[0], p[1], p[2]), colourOf(rgba, rgba[3]));
  }
}

void GrassMarkers::build(const std::vector<Viewpoint>& viewers, Nanoseconds stamp) {
  const std::vector<Viewpoint> eyes =
      viewers.empty() ? std::vector<Viewpoint>{eyeAbove(meadow_)} : viewers;
  meadow_.setViewpoints(eyes);
  meadow_.advance(stamp);
  addGround();
  std::vector<grass::TileView> views = meadow_.viewOf(eyes[0], stamp);
  const double size = meadow_.map().law().resolution;
  const auto distance = [&](const grass::TileView& v) {
    const double x = meadow_.map().law().origin_x + (v.column + 0.5) * size - eyes[0].position.x();
    const double y = meadow_.map().law().origin_y + (v.row + 0.5) * size - eyes[0].position.y();
    return x * x + y * y;
  };
  std::stable_sort(views.begin(), views.end(),
                   [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  std::vector<grass::TilePlace> places;
  for (const grass::TileView& view : views) places.push_back({view.column, view.row});
  grass::NodeWind air(meadow_.map(), meadow_.terrain());
  air.update(wind_.at(stamp), colours_.at(stamp), grass::MeadowLod::windowOf(views), &places);
  for (grass::GrassMesh* mesh : {&strip_mesh_, &blade_mesh_}) {
    mesh->clear();
    mesh->origin = Vec3(eyes[0].position.x(), eyes[0].position.y(), 0.0);
  }
  for (const grass::TileView& view : views) {
    grass::TileMotion motion;
    const grass::Tile tile = meadow_.tileAt(view, air, field_.tread(), stamp, patch_, motion);
    motion.model = field_.layout().blade_model;
    addTile(view, tile, motion, eyes[0].position);
  }
  copy(strip_mesh_, STRIPS);
  copy(blade_mesh_, BLADES);
}

}  // namespace vegetation_sim
