// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vegetation_sim/canopy/leaf_motion.h"

namespace vegetation_sim::canopy {

/// Eye, axes and angles of a perspective picture.
struct ImageFrame {
  Vec3 eye{Vec3::Zero()};  ///< [m], world
  Axes axes;               ///< `out` points against the viewing direction
  double half_width{1.0};  ///< tangents of half of the angles of view
  double half_height{1.0};

  /// Depth of a point along the viewing direction [m].
  double depthOf(const Vec3& world) const { return -dot(axes.out, Vec3(world - eye)); }
};

/// Point of a leaf at rest, which the picture of its layer shows.
struct LeafPoint {
  Vec3 at, anchor;  ///< [m], world; the anchor selects the layer
  Freedom freedom;
};

/// A grid on the picture of one layer at rest (paper 3, section 3.6; S3-27). Its nodes move as the
/// leaves around them would; drawn with the picture on it, it shows the layer in motion at a cost
/// that does not depend on the number of leaves. Nodes have the mean depth of their leaves, so that
/// the picture remains valid for eyes nearby.
class LayerGrid {
 public:
  /// @param columns, rows number of cells.
  LayerGrid(const ImageFrame& frame, int columns, int rows);

  /// Adds a point of a leaf of the layer. Points outside the picture count for nothing.
  void add(const LeafPoint& point);
  /// Computes the nodes from all points. Nodes without points continue their neighbours.
  void finish();

  /// Computes the displacement of every node.
  void move(const Foliage& foliage);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  const ImageFrame& frame() const { return frame_; }
  /// Positions of the nodes, row after row from the lowest [m], world: at rest and moved.
  const std::vector<Vec3>& rest() const { return rest_; }
  const std::vector<Vec3>& moved() const { return moved_; }
  /// Returns the corner nodes of each cell that shows leaves: low left, low right, high left, high
  /// right.
  const std::vector<std::array<std::uint32_t, 4>>& cells() const { return cells_; }

  /// Returns where on the moved grid the picture shows a point at rest [m], world.
  Vec3 warped(const Vec3& point) const;
  /// Returns the predicted error of leaves on the moved grid, seen from `eye`: a root mean square
  /// over the leaves [rad]. It follows from how much freedoms and depths differ among the leaves of
  /// a cell.
  double predictedError(const Vec3& eye) const;

 private:
  struct Node {
    double weight{0.0}, depth{0.0}, anchor_depth{0.0};  // sums until finish(), then means
    Freedom freedom;
  };
  struct Sample {
    double column, row, inverse_depth, share;
  };
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row * (columns_ + 1) + column);
  }
  Vec3 onRay(int column, int row, double depth) const;
  bool place(const Vec3& world, double& column, double& row) const;
  template <class Value>
  auto interpolated(double column, double row, const Value& value) const;
  void continueNodes();
  void findCells();
  void measureSpread();

  ImageFrame frame_;
  int columns_, rows_;
  std::vector<Node> nodes_;
  std::vector<Sample> samples_;
  std::vector<Vec3> rest_, anchors_, moved_;
  std::vector<std::array<std::uint32_t, 4>> cells_;
  // Root mean squares over the leaves.
  double share_{0.0}, share_spread_{0.0}, depth_spread_{0.0}, inverse_depth_{0.0};
  double motion_{0.0};  // root mean square displacement for a share of 1 [m]
};

}  // namespace vegetation_sim::canopy
