// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/grass_cover.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr int SIDE = grass::TreadBlock::SIDE;

/// Largest crush (0 to 1) of each cell, and the stamp of its newest press; 0: none.
struct Trodden {
  std::vector<float> crush;
  std::vector<Nanoseconds> stamp;
};

class CoverMaker {
 public:
  CoverMaker(const grass::TreadSimulation& field, const CoverSettings& settings)
      : field_(field), law_(field.layout().map->law()), settings_(settings) {
    const double size = law_.resolution / settings.resolution;
    columns_ = static_cast<int>(std::ceil(size * (law_.columns - 1) - 1e-9));
    rows_ = static_cast<int>(std::ceil(size * (law_.rows - 1) - 1e-9));
  }

  nav_msgs::OccupancyGrid make(CoverLayer layer) const {
    nav_msgs::OccupancyGrid out;
    out.header.stamp = toStamp(field_.stamp());
    out.info.resolution = static_cast<float>(settings_.resolution);
    out.info.width = static_cast<std::uint32_t>(columns_);
    out.info.height = static_cast<std::uint32_t>(rows_);
    out.info.origin.position.x = law_.origin_x;
    out.info.origin.position.y = law_.origin_y;
    out.info.origin.orientation.w = 1.0;
    out.data = dataOf(layer);
    return out;
  }

 private:
  std::vector<std::int8_t> dataOf(CoverLayer layer) const {
    std::vector<std::int8_t> out(cells());
    if (layer == CoverLayer::CRUSH || layer == CoverLayer::AGE) {
      const Trodden trodden = findTrodden();
      for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = layer == CoverLayer::CRUSH ? percent(double{trodden.crush[i]}, 1.0)
                                            : age(trodden.stamp[i]);
      return out;
    }
    const Trodden trodden = layer == CoverLayer::RESISTANCE ? findTrodden() : Trodden();
    std::vector<double> values(cells());
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column) {
        const std::size_t i = static_cast<std::size_t>(row) * columns_ + column;
        const grass::Features f =
            field_.layout().map->at(law_.origin_x + (column + 0.5) * settings_.resolution,
                                    law_.origin_y + (row + 0.5) * settings_.resolution);
        values[i] = layer == CoverLayer::DENSITY ? f.density : f.density * f.height;
      }
    const double most = *std::max_element(values.begin(), values.end());
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = percent(
          trodden.crush.empty() ? values[i] : values[i] * (1.0 - double{trodden.crush[i]}), most);
    return out;
  }

  // Only trodden blocks are visited.
  Trodden findTrodden() const {
    Trodden out{std::vector<float>(cells()), std::vector<Nanoseconds>(cells())};
    const double spacing = field_.tread().spacing() / settings_.resolution;
    for (const auto& [place, block] : field_.tread().state().blocks)
      for (int i = 0; i < SIDE * SIDE; ++i) {
        const grass::TreadNode& node = block.nodes[static_cast<std::size_t>(i)];
        const float tilt = tiltAt(node, field_.stamp());
        if (!(tilt > 0.f)) continue;
        const int column = static_cast<int>((place.second * SIDE + i % SIDE) * spacing);
        const int row = static_cast<int>((place.first * SIDE + i / SIDE) * spacing);
        const std::size_t cell = static_cast<std::size_t>(std::min(row, rows_ - 1)) * columns_ +
                                 std::min(column, columns_ - 1);
        out.crush[cell] = std::max(out.crush[cell], tilt / static_cast<float>(grass::BEND_LIMIT));
        out.stamp[cell] = std::max(out.stamp[cell], node.stamp);
      }
    return out;
  }

  std::size_t cells() const { return static_cast<std::size_t>(columns_) * rows_; }
  std::int8_t age(Nanoseconds stamp) const {
    if (stamp == 0) return -1;
    return percent(secondsBetween(stamp, field_.stamp()), settings_.full_age);
  }
  static std::int8_t percent(double value, double of) {
    if (!(of > 0.0)) return 0;
    return static_cast<std::int8_t>(
        std::floor(100.0 * std::min(1.0, std::max(0.0, value / of)) + 0.5));
  }

  const grass::TreadSimulation& field_;
  const grass::MapLaw& law_;
  CoverSettings settings_;
  int columns_, rows_;
};

}  // namespace

nav_msgs::OccupancyGrid coverOf(const grass::TreadSimulation& field, CoverLayer layer,
                                const CoverSettings& settings) {
  return CoverMaker(field, settings).make(layer);
}

}  // namespace vegetation_sim
