// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/grass_cover.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr int SIDE = grass::TreadBlock::SIDE;

int cellsAlong(const grass::MapLaw& law, int nodes, double resolution) {
  return static_cast<int>(std::ceil(law.resolution / resolution * (nodes - 1) - 1e-9));
}

// Only trodden blocks are visited.
void addTreads(const grass::TreadSimulation& field, double resolution, GrassCover& cover) {
  const int rows = static_cast<int>(cover.info.height),
            columns = static_cast<int>(cover.info.width);
  const double spacing = field.tread().spacing() / resolution;
  cover.crush.assign(cover.density.size(), 0.f);
  cover.age.assign(cover.density.size(), -1.f);
  for (const auto& [place, block] : field.tread().state().blocks)
    for (int i = 0; i < SIDE * SIDE; ++i) {
      const grass::TreadNode& node = block.nodes[static_cast<std::size_t>(i)];
      const float tilt = tiltAt(node, field.stamp());
      if (!(tilt > 0.f)) continue;
      const int column = static_cast<int>((place.second * SIDE + i % SIDE) * spacing);
      const int row = static_cast<int>((place.first * SIDE + i / SIDE) * spacing);
      const std::size_t cell = static_cast<std::size_t>(std::min(row, rows - 1)) * columns +
                               std::min(column, columns - 1);
      const auto age = static_cast<float>(secondsBetween(node.stamp, field.stamp()));
      cover.crush[cell] = std::max(cover.crush[cell], tilt / static_cast<float>(grass::BEND_LIMIT));
      cover.age[cell] = cover.age[cell] < 0.f ? age : std::min(cover.age[cell], age);
    }
}

// Only cut blocks are visited. A node counts for the square around it.
void addCuts(const grass::TreadSimulation& field, double resolution, GrassCover& cover) {
  const int rows = static_cast<int>(cover.info.height),
            columns = static_cast<int>(cover.info.width);
  cover.cut.assign(cover.density.size(), 0.f);
  cover.swath.assign(cover.density.size(), 0.f);
  const double spacing = field.tread().spacing() / resolution;
  // A cell that is smaller than the spacing takes the value of a node as its own.
  const double part = std::min(1.0, spacing * spacing);
  std::vector<double> removed(cover.density.size(), 0.0);
  for (const auto& [place, block] : field.tread().cuts().state().blocks)
    for (int i = 0; i < SIDE * SIDE; ++i) {
      const grass::CutNode& node = block.nodes[static_cast<std::size_t>(i)];
      const int column = static_cast<int>((place.second * SIDE + i % SIDE) * spacing);
      const int row = static_cast<int>((place.first * SIDE + i / SIDE) * spacing);
      const std::size_t cell = static_cast<std::size_t>(std::min(row, rows - 1)) * columns +
                               std::min(column, columns - 1);
      cover.swath[cell] += static_cast<float>(part * node.swath);
      const double cut = double{cover.height[cell]} - double{node.height};
      if (!(cut > 0.0)) continue;
      cover.cut[cell] = std::min(1.f, cover.cut[cell] + static_cast<float>(part));
      removed[cell] += part * cut;
    }
  for (std::size_t i = 0; i < removed.size(); ++i)
    cover.height[i] = std::max(0.f, cover.height[i] - static_cast<float>(removed[i]));
}

std::int8_t percent(double share) {
  return static_cast<std::int8_t>(std::floor(100.0 * std::clamp(share, 0.0, 1.0) + 0.5));
}

}  // namespace

GrassCover groundOf(const grass::FeatureMap& map, double resolution) {
  const grass::MapLaw& law = map.law();
  GrassCover out;
  out.info.resolution = static_cast<float>(resolution);
  out.info.width = static_cast<std::uint32_t>(cellsAlong(law, law.columns, resolution));
  out.info.height = static_cast<std::uint32_t>(cellsAlong(law, law.rows, resolution));
  out.info.origin.position.x = law.origin_x;
  out.info.origin.position.y = law.origin_y;
  out.info.origin.orientation.w = 1.0;
  for (std::uint32_t row = 0; row < out.info.height; ++row)
    for (std::uint32_t column = 0; column < out.info.width; ++column) {
      const grass::Features features = map.at(law.origin_x + (column + 0.5) * resolution,
                                              law.origin_y + (row + 0.5) * resolution);
      out.density.push_back(static_cast<float>(features.density));
      out.height.push_back(static_cast<float>(features.height));
    }
  return out;
}

GrassCover coverOf(const grass::TreadSimulation& field, GrassCover ground, double resolution) {
  GrassCover out = std::move(ground);
  out.header.stamp = toStamp(field.stamp());
  addTreads(field, resolution, out);
  addCuts(field, resolution, out);
  for (std::size_t i = 0; i < out.density.size(); ++i)
    out.resistance.push_back(static_cast<float>(field.drag()) * out.density[i] * out.height[i] *
                             std::max(0.f, 1.f - out.crush[i]));
  return out;
}

nav_msgs::OccupancyGrid percentOf(const GrassCover& cover, CoverLayer layer,
                                  const CoverScale& scale) {
  const std::vector<float>* const values[] = {&cover.crush, &cover.density, &cover.resistance,
                                              &cover.age, &cover.cut};
  const double full[] = {1.0, scale.density, scale.resistance, scale.age, 1.0};
  const auto index = static_cast<std::size_t>(layer);
  nav_msgs::OccupancyGrid out;
  out.header = cover.header;
  out.info = cover.info;
  for (const float value : *values[index])
    out.data.push_back(value < 0.f ? std::int8_t{-1} : percent(double{value} / full[index]));
  return out;
}

}  // namespace vegetation_sim
