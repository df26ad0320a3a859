// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/core/math/math.h"

// The scene of S1-41, shared by test and bench: a square forest of rich trees, three wind disks
// over a third of it, one camera at its edge.

namespace vegetation_sim::forest {

struct TreeBatch {
  Layout layout;
  std::vector<Tree> trees;
  std::vector<BatchPoser> posers;
  std::size_t branches{0};
};

inline TreeBatch growTrees(Layout layout) {
  TreeBatch out;
  out.layout = std::move(layout);
  for (std::uint32_t id = 0; id < out.layout.treeCount(); ++id) {
    out.trees.push_back(growTree(out.layout, id, terrain::HeightMap()));
    out.posers.emplace_back(out.trees.back());
    out.branches += out.trees.back().skeleton.branches.size();
  }
  return out;
}

/// Raises the number of children until every tree has at least `least` branches.
inline Layout richLayout(int side, double spacing, std::size_t least) {
  Layout out = gridLayout(side, spacing);
  for (std::size_t s = 0; s < out.species.size(); ++s) {
    const Species plain = out.species[s];
    Design design;
    for (std::size_t fewest = 0; fewest < least; design.children *= 1.05) {
      out.species[s] = applyDesign(plain, design);
      fewest = SIZE_MAX;
      for (std::uint32_t id = static_cast<std::uint32_t>(s); id < out.treeCount(); id += 4)
        fewest = std::min(fewest, grow(out.trees[id], out.species[s]).branches.size());
    }
  }
  return out;
}

constexpr double FIELD_OF_VIEW = 0.8;  // vertical [rad]
constexpr double PICTURE_HEIGHT = 900, PICTURE_WIDTH = 1280;

struct Camera {
  Viewpoint eye;
  Vec3 forward, left, up;
  /// Computes the pixel of a point; returns false if it is behind the camera or outside the image.
  bool project(const Vec3& point, double& x, double& y) const {
    const Vec3 offset = point - eye.position;
    const double depth = dot(offset, forward);
    if (depth < 0.1) return false;
    const double f = 0.5 * PICTURE_HEIGHT / std::tan(0.5 * FIELD_OF_VIEW);
    x = -f * dot(offset, left) / depth;
    y = -f * dot(offset, up) / depth;
    return std::fabs(x) < 0.5 * PICTURE_WIDTH && std::fabs(y) < 0.5 * PICTURE_HEIGHT;
  }
};

inline Camera edgeCamera(double extent) {
  Camera out;
  out.eye.position = Vec3(-12.0, 0.5 * extent, 3.0);
  out.eye.pixels_per_radian = 0.5 * PICTURE_HEIGHT / std::tan(0.5 * FIELD_OF_VIEW);
  out.forward = out.eye.forward = Vec3(1, 0, 0);
  out.eye.cone_cosine = 0.7;  // 0.8 rad: the picture's corner at 0.63 and a margin
  out.left = Vec3(0, 1, 0);
  out.up = Vec3(0, 0, 1);
  return out;
}

/// Returns three disks that cover about a third of the square.
inline wind::Field threeDiscs(double extent) {
  const double r = std::sqrt(extent * extent / 3.0 / 3.0 / PI);
  return wind::Field({makeDisk(1, Vec3(0.2, 0.25, 0) * extent, r, Vec3(5, 1, 0)),
                      makeDisk(2, Vec3(0.55, 0.7, 0) * extent, r, Vec3(4, -2, 0)),
                      makeDisk(3, Vec3(0.85, 0.3, 0) * extent, r, Vec3(0, 5, 0))});
}

struct LevelError {
  double pixels{0.0}, metres{0.0};
};

inline LevelError errorOfLevels(const TreeBatch& grove, const Forest& forest, const Camera& camera,
                                const wind::Instant& wind, Nanoseconds stamp) {
  LevelError out;
  for (std::uint32_t id = 0; id < grove.trees.size(); ++id) {
    const Tree& tree = grove.trees[id];
    const auto local = wind.relativeTo(tree.foot);
    const auto full = poseBranches(tree, local, fullWeights());
    const auto cut = poseBranches(
        tree, local, weightsAt(forest.view().levels.of(id), stamp, forest.layout().motion));
    for (std::size_t b = 0; b < full.size(); ++b) {
      const Vec3 a = tree.foot + tipOf(tree.skeleton.branches[b], full[b]);
      const Vec3 c = tree.foot + tipOf(tree.skeleton.branches[b], cut[b]);
      out.metres = std::max(out.metres, length(a - c));
      double ax, ay, cx, cy;
      if (camera.project(a, ax, ay) && camera.project(c, cx, cy))
        out.pixels = std::max(out.pixels, std::hypot(ax - cx, ay - cy));
    }
  }
  return out;
}

inline void settle(Forest& forest, const Camera& camera, const TickGrid& grid, std::int64_t first,
                   int ticks) {
  for (std::int64_t k = first; k < first + ticks; ++k) {
    forest.setViewers({camera.eye});
    forest.advance(grid.timeOf(k));
  }
}

/// Poses every moving branch; returns their number.
inline std::size_t poseAtLevels(const TreeBatch& grove, const Forest& forest,
                                const wind::Instant& wind, Nanoseconds stamp, BatchPoses& scratch) {
  std::size_t posed = 0;
  for (const auto& [id, state] : forest.view().levels.held()) {
    const Weights weights = weightsAt(state, stamp, forest.layout().motion);
    const int depths = movingDepths(weights);
    grove.posers[id].pose(wind.relativeTo(grove.trees[id].foot), weights, depths, scratch);
    posed += static_cast<std::size_t>(scratch.count);
  }
  return posed;
}

}  // namespace vegetation_sim::forest
