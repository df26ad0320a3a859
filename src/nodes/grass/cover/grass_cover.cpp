// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/cover/grass_cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "grass/tread/tread_recovery.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr int SIDE = grass::TreadBlock::SIDE;
constexpr std::size_t WIDTH = SIDE, NODES = WIDTH * WIDTH;

int cellsAlong(const grass::MapLaw& law, int nodes, double resolution) {
  return static_cast<int>(std::ceil(law.resolution / resolution * (nodes - 1) - 1e-9));
}

// The cells of a block's nodes along an axis: successive nodes are mostly in one cell.
struct CellsOfBlock {
  // @param first node of the block. @param last cell of the axis. @param spacing of nodes over that
  // of cells.
  CellsOfBlock(int first, int last, double spacing) {
    for (int i = 0; i < SIDE; ++i) {
      const int cell = std::min(static_cast<int>((first + i) * spacing), last);
      if (count == 0 || cells[count - 1] != cell) cells[count++] = cell;
      index[static_cast<std::size_t>(i)] = count - 1;
    }
  }
  std::array<int, SIDE> cells{};          // without repetitions
  std::array<std::size_t, SIDE> index{};  // of each node's cell
  std::size_t count{0};
};

// Calls visit(cell, crush, age) for the trodden cells of each trodden block: one of several blocks
// is visited several times.
template <class Visit>
void visitTreads(const grass::TreadSimulation& field, const nav_msgs::MapMetaData& info,
                 double resolution, const Visit& visit) {
  const int rows = static_cast<int>(info.height), columns = static_cast<int>(info.width);
  const double spacing = field.tread().spacing() / resolution;
  struct Cell {
    float crush{0.f}, age{-1.f};
  };
  for (const auto& [place, block] : field.tread().state().blocks) {
    const CellsOfBlock down(place.first * SIDE, rows - 1, spacing);
    const CellsOfBlock across(place.second * SIDE, columns - 1, spacing);
    std::array<Cell, NODES> cells;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const grass::TreadNode& node = block.nodes[i];
      const float tilt = tiltAt(node, field.stamp());
      if (!(tilt > 0.f)) continue;
      Cell& cell = cells[down.index[i / WIDTH] * WIDTH + across.index[i % WIDTH]];
      const auto age = static_cast<float>(secondsBetween(node.stamp, field.stamp()));
      cell.crush = std::max(cell.crush, tilt / static_cast<float>(grass::BEND_LIMIT));
      cell.age = cell.age < 0.f ? age : std::min(cell.age, age);
    }
    for (std::size_t row = 0; row < down.count; ++row)
      for (std::size_t column = 0; column < across.count; ++column) {
        const Cell& cell = cells[row * WIDTH + column];
        if (!(cell.crush > 0.f)) continue;
        visit(static_cast<std::size_t>(down.cells[row]) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(across.cells[column]),
              cell.crush, cell.age);
      }
  }
}

// The most trodden node of a cell counts, and the one that was trodden last.
void addTread(std::size_t cell, float crush, float age, GrassCover& cover) {
  cover.crush[cell] = std::max(cover.crush[cell], crush);
  cover.age[cell] = cover.age[cell] < 0.f ? age : std::min(cover.age[cell], age);
}

// Returns the number of nodes in each cell along an axis; `spacing` is that of nodes over that of
// cells. Nodes on the far border are in the last cell.
std::vector<int> nodesAlong(int cells, int nodes, double spacing) {
  std::vector<int> out(static_cast<std::size_t>(cells), 0);
  for (int i = 0; i < nodes; ++i)
    ++out[static_cast<std::size_t>(std::min(static_cast<int>(i * spacing), cells - 1))];
  return out;
}

// Takes the mean over the nodes of a cell, or the node that is nearest to the middle of a cell
// without any. Only cut blocks are visited if every cell has nodes.
class CutLayers {
 public:
  CutLayers(const grass::TreadSimulation& field, double resolution, GrassCover& cover)
      : field_(field), resolution_(resolution), cover_(cover) {
    cover_.cut.assign(cover_.density.size(), 0.f);
    cover_.swath.assign(cover_.density.size(), 0.f);
    removed_.assign(cover_.density.size(), 0.0);
  }

  void fill() {
    const grass::CutState& state = field_.tread().cuts().state();
    if (state.blocks.empty()) return;
    const grass::MapLaw& law = field_.layout().map->law();
    const int rows = static_cast<int>(cover_.info.height);
    const int columns = static_cast<int>(cover_.info.width);
    const double step = field_.tread().spacing(), spacing = step / resolution_;
    const auto count = [&](int tiles) {
      return static_cast<int>(std::lround((tiles - 1) * law.resolution / step)) + 1;
    };
    const std::vector<int> in_row = nodesAlong(rows, count(law.rows), spacing);
    const std::vector<int> in_column = nodesAlong(columns, count(law.columns), spacing);
    for (const auto& [place, block] : state.blocks)
      for (int i = 0; i < SIDE * SIDE; ++i) {
        const auto row = static_cast<std::size_t>(
            std::min(static_cast<int>((place.first * SIDE + i / SIDE) * spacing), rows - 1));
        const auto column = static_cast<std::size_t>(
            std::min(static_cast<int>((place.second * SIDE + i % SIDE) * spacing), columns - 1));
        add(row, column, block.nodes[static_cast<std::size_t>(i)], in_row[row] * in_column[column]);
      }
    for (std::size_t row = 0; row < in_row.size(); ++row)
      for (std::size_t column = 0; column < in_column.size(); ++column)
        if (in_row[row] * in_column[column] == 0)
          add(row, column,
              field_.tread().cuts().at(
                  {law.origin_x + (static_cast<double>(column) + 0.5) * resolution_,
                   law.origin_y + (static_cast<double>(row) + 0.5) * resolution_}),
              1);
    for (std::size_t i = 0; i < removed_.size(); ++i)
      cover_.height[i] = std::max(0.f, cover_.height[i] - static_cast<float>(removed_[i]));
  }

 private:
  void add(std::size_t row, std::size_t column, const grass::CutNode& node, int nodes) {
    const std::size_t cell = row * cover_.info.width + column;
    const double part = nodes > 0 ? 1.0 / nodes : 0.0;
    cover_.swath[cell] += static_cast<float>(part * node.swath);
    const double cut = double{cover_.height[cell]} - double{node.height};
    if (!(cut > 0.0)) return;
    cover_.cut[cell] = std::min(1.f, cover_.cut[cell] + static_cast<float>(part));
    removed_[cell] += part * cut;
  }

  const grass::TreadSimulation& field_;
  double resolution_;
  GrassCover& cover_;
  std::vector<double> removed_;  // height by cell [m]
};

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

GrassCoverPart troddenCells(const grass::TreadSimulation& field, const nav_msgs::MapMetaData& info,
                            double resolution) {
  GrassCoverPart out;
  out.header.stamp = toStamp(field.stamp());
  out.info = info;
  struct Trodden {
    std::size_t cell;
    float crush, age;
  };
  std::vector<Trodden> nodes;
  nodes.reserve(4 * field.tread().state().blocks.size());
  visitTreads(field, info, resolution, [&](std::size_t cell, float crush, float age) {
    nodes.push_back({cell, crush, age});
  });
  std::sort(nodes.begin(), nodes.end(),
            [](const Trodden& a, const Trodden& b) { return a.cell < b.cell; });
  for (const Trodden& node : nodes) {
    if (out.cells.empty() || out.cells.back() != node.cell) {
      out.cells.push_back(static_cast<std::uint32_t>(node.cell));
      out.crush.push_back(node.crush);
      out.age.push_back(node.age);
    } else {
      out.crush.back() = std::max(out.crush.back(), node.crush);
      out.age.back() = std::min(out.age.back(), node.age);
    }
  }
  return out;
}

GrassCover coverOf(const grass::TreadSimulation& field, GrassCover ground, double resolution) {
  GrassCover out = std::move(ground);
  out.header.stamp = toStamp(field.stamp());
  out.crush.assign(out.density.size(), 0.f);
  out.age.assign(out.density.size(), -1.f);
  visitTreads(field, out.info, resolution,
              [&](std::size_t cell, float crush, float age) { addTread(cell, crush, age, out); });
  CutLayers(field, resolution, out).fill();
  return out;
}

void addTreads(const GrassCoverPart& part, GrassCover& cover) {
  for (std::size_t i = 0; i < part.cells.size(); ++i)
    addTread(part.cells[i], part.crush[i], part.age[i], cover);
}

void addResistance(double drag, GrassCover& cover) {
  cover.resistance.resize(cover.density.size());
  for (std::size_t i = 0; i < cover.density.size(); ++i)
    cover.resistance[i] = static_cast<float>(drag) * cover.density[i] * cover.height[i] *
                          std::max(0.f, 1.f - cover.crush[i]);
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
