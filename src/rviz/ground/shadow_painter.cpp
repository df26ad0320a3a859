// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/ground/shadow_painter.h"

#include <algorithm>
#include <cmath>

#include "tree/mesh/bark_mesh.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

constexpr double LEAF_DEPTH = 0.55;     // optical depth of one leaf cluster, seen from the sun
constexpr double WOOD_DEPTH = 1.5;      // of a ball of wood
constexpr double WOOD_STEP = 0.15;      // [m] between such balls
constexpr double THINNEST = 0.7;        // [pixel] radius of a shadow
constexpr float DARKEST = 0.62f;        // alpha of an overlay without sunlight
constexpr double OVERLAY_BORDER = 0.1;  // share of the edge over which an overlay fades out

// Leaves hide the wood of the outer branches.
int woodBalls(const forest::Branch& branch, bool leaves) {
  return branch.depth > 1 && leaves ? 0 : 1 + static_cast<int>(branch.length / WOOD_STEP);
}

// Returns the share of an overlay that is left at a pixel of a row or column.
float shareInside(int pixel, int edge) {
  const double from_border = std::min(pixel + 0.5, edge - pixel - 0.5) / edge;
  return static_cast<float>(smoothStep(from_border / OVERLAY_BORDER));
}

}  // namespace

ShadowPainter::ShadowPainter(const Plot& plot, int edge, const Window& window,
                             const terrain::HeightMap& terrain, const Vec3& to_sun)
    : plot_(plot),
      edge_(edge),
      window_(window),
      terrain_(terrain),
      slope_(to_sun / std::max(to_sun.z(), 0.15)),
      depths_(static_cast<std::size_t>(window.columns) * static_cast<std::size_t>(window.rows),
              0.f) {}

void ShadowPainter::drop(const Vec3& from, double radius, double depth) {
  Vec3 at = from;
  for (int i = 0; i < 3; ++i)  // iterates along the ray to the nearly flat ground
    at = at - (at.z() - terrain_.height(at.x(), at.y())) * slope_;
  const double pixel = plot_.edge / edge_;
  const double column = (at.x() - plot_.x) / pixel, row = (at.y() - plot_.y) / pixel;
  const double reach = std::max(radius / pixel, THINNEST);
  depth *= std::min(1.0, radius / pixel / THINNEST);  // thinner than a pixel is fainter
  const int last_row = std::min(window_.row + window_.rows - 1, static_cast<int>(row + reach));
  const int last_column =
      std::min(window_.column + window_.columns - 1, static_cast<int>(column + reach));
  for (int r = std::max(window_.row, static_cast<int>(row - reach)); r <= last_row; ++r) {
    for (int c = std::max(window_.column, static_cast<int>(column - reach)); c <= last_column;
         ++c) {
      const double x = (c + 0.5 - column) / reach, y = (r + 0.5 - row) / reach;
      const double inside = 1.0 - x * x - y * y;
      if (inside > 0.0)
        depths_[static_cast<std::size_t>((r - window_.row) * window_.columns + c -
                                         window_.column)] += static_cast<float>(depth * inside);
    }
  }
}

std::vector<float> ShadowPainter::light() const {
  std::vector<float> out = depths_;
  for (float& depth : out) depth = std::exp(-std::max(0.f, depth));
  return out;
}

void dropTree(const DrawnTree& tree, const std::vector<Pose>& poses, bool leaves, double depth,
              const ShadowDrop& drop) {
  const double radius = 0.5 * tree.leafSize();
  const auto& branches = tree.tree().skeleton.branches;
  for (std::size_t i = 0; i < branches.size(); ++i) {
    const forest::Branch& branch = branches[i];
    if (branch.broken) continue;
    const Pose& pose = poses.empty() ? branch.rest : poses[i];
    const Vec3 base = tree.foot() + pose.position;
    const Vec3 tip = tree.foot() + tipOf(branch, pose);
    for (int leaf = 0; leaves && leaf < branch.leaves; ++leaf)
      drop(base + (tip - base) * ((leaf + 0.8) / branch.leaves), radius, depth * LEAF_DEPTH);
    const int steps = woodBalls(branch, leaves);
    for (int s = 0; s < steps; ++s)
      drop(base + (tip - base) * (static_cast<double>(s) / steps), branch.base_radius,
           depth * WOOD_DEPTH);
  }
}

std::size_t countDrops(const DrawnTree& tree, bool leaves) {
  std::size_t out = 0;
  for (const forest::Branch& branch : tree.tree().skeleton.branches)
    if (!branch.broken)
      out += static_cast<std::size_t>((leaves ? branch.leaves : 0) + woodBalls(branch, leaves));
  return out;
}

std::vector<float> castShadows(const Plot& plot, int edge, const Window& window,
                               const terrain::HeightMap& terrain, const Vec3& to_sun,
                               const std::function<void(const ShadowDrop&)>& report) {
  ShadowPainter painter(plot, edge, window, terrain, to_sun);
  report([&](const Vec3& at, double radius, double depth) { painter.drop(at, radius, depth); });
  return painter.light();
}

std::vector<float> shadowsOn(const Plot& plot, int edge, const TreeSet& tree_set,
                             const terrain::HeightMap& terrain, const Vec3& to_sun) {
  return castShadows(plot, edge, wholePlot(edge), terrain, to_sun, [&](const ShadowDrop& drop) {
    for (const auto& tree : tree_set.trees()) dropTree(*tree, {}, tree_set.hasLeaves(), 1.0, drop);
  });
}

Image overlayPicture(const std::vector<float>& light, int edge, const Window& window) {
  Image out(window.columns, window.rows, {1.f, 1.f, 1.f, 0.f});
  std::vector<float> across;
  for (int c = 0; c < window.columns; ++c) across.push_back(shareInside(window.column + c, edge));
  for (int r = 0; r < window.rows; ++r) {
    const float most = DARKEST * shareInside(window.row + r, edge);
    for (int c = 0; c < window.columns; ++c)
      out.at(c, window.rows - 1 - r)[3] =
          most * across[static_cast<std::size_t>(c)] *
          (1.f - light[static_cast<std::size_t>((window.row + r) * edge + window.column + c)]);
  }
  return out;
}

}  // namespace vegetation_sim::view
