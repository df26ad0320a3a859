// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/layer_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vegetation_sim::canopy {
namespace {

constexpr double NEAREST_POINT = 0.05;  // [m] nothing nearer is visible
constexpr int MOTION_CELLS = 2;  // [cells] by which moved leaves leave the cells of their points

}  // namespace

LayerGrid::LayerGrid(const ImageFrame& frame, int columns, int rows)
    : frame_(frame),
      columns_(columns),
      rows_(rows),
      nodes_(static_cast<std::size_t>((columns + 1) * (rows + 1))) {}

bool LayerGrid::place(const Vec3& world, double& column, double& row) const {
  const Vec3 seen = into(frame_.axes, world - frame_.eye);
  const double depth = -seen.z();
  if (!(depth > NEAREST_POINT)) return false;
  column = 0.5 * (seen.x() / (depth * frame_.half_width) + 1.0) * columns_;
  row = 0.5 * (seen.y() / (depth * frame_.half_height) + 1.0) * rows_;
  return column >= 0.0 && row >= 0.0 && column <= columns_ && row <= rows_;
}

Vec3 LayerGrid::onRay(int column, int row, double depth) const {
  const double x = (2.0 * column / columns_ - 1.0) * frame_.half_width;
  const double y = (2.0 * row / rows_ - 1.0) * frame_.half_height;
  return frame_.eye + outOf(frame_.axes, depth * Vec3(x, y, -1.0));
}

// Interpolates bilinearly between the nodes of a cell.
template <class Value>
auto LayerGrid::interpolated(double column, double row, const Value& value) const {
  const int left = std::clamp(static_cast<int>(column), 0, columns_ - 1);
  const int low = std::clamp(static_cast<int>(row), 0, rows_ - 1);
  const double p = column - left, q = row - low;
  using Result = std::decay_t<decltype(value(std::size_t{0}))>;
  return Result(
      (1.0 - q) * ((1.0 - p) * value(index(left, low)) + p * value(index(left + 1, low))) +
      q * ((1.0 - p) * value(index(left, low + 1)) + p * value(index(left + 1, low + 1))));
}

void LayerGrid::add(const LeafPoint& point) {
  double column = 0.0, row = 0.0;
  if (!place(point.at, column, row)) return;
  const double depth = frame_.depthOf(point.at), anchor_depth = frame_.depthOf(point.anchor);
  const int left = std::min(static_cast<int>(column), columns_ - 1);
  const int low = std::min(static_cast<int>(row), rows_ - 1);
  for (int corner = 0; corner < 4; ++corner) {
    const int x = left + corner % 2, y = low + corner / 2;
    const double weight = (1.0 - std::fabs(column - x)) * (1.0 - std::fabs(row - y));
    Node& node = nodes_[index(x, y)];
    node.weight += weight;
    node.depth += weight * depth;
    node.anchor_depth += weight * anchor_depth;
    node.freedom.share += weight * point.freedom.share;
    node.freedom.limit += weight * point.freedom.limit;
  }
  samples_.push_back({column, row, 1.0 / depth, point.freedom.share});
}

void LayerGrid::finish() {
  for (Node& node : nodes_) {
    if (!(node.weight > 0.0)) continue;
    for (double* sum : {&node.depth, &node.anchor_depth, &node.freedom.share, &node.freedom.limit})
      *sum /= node.weight;
  }
  findCells();
  for (int i = 0; i < 2 * MOTION_CELLS; ++i) continueNodes();
  rest_.resize(nodes_.size(), frame_.eye);
  anchors_ = rest_;
  for (int row = 0; row <= rows_; ++row)
    for (int column = 0; column <= columns_; ++column) {
      const Node& node = nodes_[index(column, row)];
      rest_[index(column, row)] = onRay(column, row, node.depth);
      anchors_[index(column, row)] = onRay(column, row, node.anchor_depth);
    }
  moved_ = rest_;
  measureSpread();
}

// Gives every node without leaves the mean of its neighbours that have values.
void LayerGrid::continueNodes() {
  const std::vector<Node> before = nodes_;
  for (int row = 0; row <= rows_; ++row)
    for (int column = 0; column <= columns_; ++column) {
      Node& node = nodes_[index(column, row)];
      if (node.weight > 0.0) continue;
      Node sum;
      for (int y = std::max(0, row - 1); y <= std::min(rows_, row + 1); ++y)
        for (int x = std::max(0, column - 1); x <= std::min(columns_, column + 1); ++x) {
          const Node& other = before[index(x, y)];
          if (!(other.weight > 0.0)) continue;
          sum.weight += 1.0;
          sum.depth += other.depth;
          sum.anchor_depth += other.anchor_depth;
          sum.freedom.share += other.freedom.share;
          sum.freedom.limit += other.freedom.limit;
        }
      if (!(sum.weight > 0.0)) continue;
      node.depth = sum.depth / sum.weight;
      node.anchor_depth = sum.anchor_depth / sum.weight;
      node.freedom = {sum.freedom.share / sum.weight, sum.freedom.limit / sum.weight};
      node.weight = 1e-9;  // has values, but no leaves
    }
}

void LayerGrid::findCells() {
  std::vector<bool> shown(static_cast<std::size_t>(columns_ * rows_), false);
  for (const Sample& sample : samples_) {
    const int column = static_cast<int>(sample.column), row = static_cast<int>(sample.row);
    for (int y = std::max(0, row - MOTION_CELLS); y <= std::min(rows_ - 1, row + MOTION_CELLS); ++y)
      for (int x = std::max(0, column - MOTION_CELLS);
           x <= std::min(columns_ - 1, column + MOTION_CELLS); ++x)
        shown[static_cast<std::size_t>(y * columns_ + x)] = true;
  }
  for (int y = 0; y < rows_; ++y)
    for (int x = 0; x < columns_; ++x)
      if (shown[static_cast<std::size_t>(y * columns_ + x)])
        cells_.push_back({static_cast<std::uint32_t>(index(x, y)),
                          static_cast<std::uint32_t>(index(x + 1, y)),
                          static_cast<std::uint32_t>(index(x, y + 1)),
                          static_cast<std::uint32_t>(index(x + 1, y + 1))});
}

void LayerGrid::measureSpread() {
  double all = 0.0, share = 0.0, depth = 0.0, inverse = 0.0;
  for (const Sample& sample : samples_) {
    const double near = interpolated(sample.column, sample.row,
                                     [&](std::size_t i) { return 1.0 / nodes_[i].depth; });
    const double freedom = interpolated(sample.column, sample.row,
                                        [&](std::size_t i) { return nodes_[i].freedom.share; });
    all += sample.share * sample.share;
    share += (sample.share - freedom) * (sample.share - freedom);
    depth += (sample.inverse_depth - near) * (sample.inverse_depth - near);
    inverse += sample.inverse_depth * sample.inverse_depth;
  }
  const double count = std::max<double>(1.0, static_cast<double>(samples_.size()));
  share_ = std::sqrt(all / count);
  share_spread_ = std::sqrt(share / count);
  depth_spread_ = std::sqrt(depth / count);
  inverse_depth_ = std::sqrt(inverse / count);
  samples_ = {};
}

void LayerGrid::move(const Foliage& foliage) {
  double square = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (!(node.weight > 0.0)) continue;
    const Vec3 free = foliage.freeDisplacement(anchors_[i], rest_[i], node.freedom.limit);
    moved_[i] = rest_[i] + node.freedom.share * free;
    square += node.weight * dot(free, free);
    weight += node.weight;
  }
  motion_ = weight > 0.0 ? std::sqrt(square / weight) : 0.0;
}

Vec3 LayerGrid::warped(const Vec3& point) const {
  double column = 0.0, row = 0.0;
  if (!place(point, column, row)) return point;
  const double inverse =
      interpolated(column, row, [&](std::size_t i) { return 1.0 / nodes_[i].depth; });
  const Vec3 moved =
      interpolated(column, row, [&](std::size_t i) { return Vec3(moved_[i] - rest_[i]); });
  return frame_.eye + (point - frame_.eye) / (inverse * frame_.depthOf(point)) + moved;
}

double LayerGrid::predictedError(const Vec3& eye) const {
  const Vec3 shift = eye - frame_.eye;
  const double along = dot(shift, frame_.axes.out);
  const double across = std::sqrt(std::max(0.0, dot(shift, shift) - along * along));
  // A step forward moves points by their angle from the axis, at most by that of the corner.
  const double corner =
      std::sqrt(frame_.half_width * frame_.half_width + frame_.half_height * frame_.half_height);
  const double eye_moved = across + 0.5 * corner * std::fabs(along), moved = share_ * motion_;
  const double motion = motion_ * share_spread_ * inverse_depth_;
  return std::sqrt(depth_spread_ * depth_spread_ * (eye_moved * eye_moved + moved * moved) +
                   motion * motion);
}

}  // namespace vegetation_sim::canopy
