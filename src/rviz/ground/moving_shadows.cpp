// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/ground/moving_shadows.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace vegetation_sim::view {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double RESELECT = 10.0;                   // [m] way of the viewer to another selection
constexpr double SMALL_PLOT = 100.0;                // [m]
constexpr int SMALL_EDGE = 512, LARGE_EDGE = 1024;  // [pixel] of a small and of another plot
constexpr double LOWEST_SUN = 0.15, SWAY = 2.0;     // lower suns cast as long shadows; room [m]

ShadowDrop dropInto(ShadowPainter& painter) {
  return [&](const Vec3& at, double radius, double depth) { painter.drop(at, radius, depth); };
}

Window unite(const Window& a, const Window& b) {
  if (a.columns * a.rows == 0) return b;
  if (b.columns * b.rows == 0) return a;
  const int column = std::min(a.column, b.column), row = std::min(a.row, b.row);
  return {column, row, std::max(a.column + a.columns, b.column + b.columns) - column,
          std::max(a.row + a.rows, b.row + b.rows) - row};
}

}  // namespace

MovingShadows::MovingShadows(const TreeSet& tree_set, const terrain::HeightMap& terrain,
                             const Vec3& to_sun)
    : tree_set_(tree_set),
      to_sun_(to_sun),
      plot_(plotAround(tree_set.extent())),
      edge_(plot_.edge > SMALL_PLOT ? LARGE_EDGE : SMALL_EDGE),
      rest_(plot_, edge_, wholePlot(edge_), terrain, to_sun),
      moved_(rest_),
      changed_(wholePlot(edge_)) {
  for (const auto& tree : tree_set.trees())
    dropTree(*tree, {}, tree_set.hasLeaves(), 1.0, dropInto(rest_));
  light_ = rest_.light();
}

// Returns where the shadow of a tree may lie.
Extent MovingShadows::shadowOf(const DrawnTree& tree) const {
  const Vec3 away = -to_sun_ / std::max(to_sun_.z(), LOWEST_SUN) * tree.height();
  const Vec3 room(tree.reach() + SWAY, tree.reach() + SWAY, 0.0);
  const Vec3 low = tree.foot(), high = tree.foot() + Vec3(away.x(), away.y(), 0.0);
  return {low.cwiseMin(high) - room, low.cwiseMax(high) + room};
}

void MovingShadows::dropNear(double depth) {
  for (const DrawnTree* tree : near_)
    dropTree(*tree, {}, tree_set_.hasLeaves(), depth, dropInto(rest_));
}

void MovingShadows::follow(const Vec3& viewer) {
  if (selected_ && length(viewer - selected_at_) < RESELECT) return;
  selected_ = true;
  selected_at_ = viewer;
  dropNear(1.0);
  near_.clear();
  for (const auto& tree : tree_set_.trees()) near_.push_back(tree.get());
  const auto distance = [&](const DrawnTree* tree) { return length(tree->foot() - viewer); };
  std::sort(near_.begin(), near_.end(), [&](const DrawnTree* a, const DrawnTree* b) {
    const double da = distance(a), db = distance(b);
    return da < db || (da == db && a->id() < b->id());
  });
  std::size_t drops = 0, count = 0;
  changed_ = unite(changed_, window_);
  window_ = Window();
  for (const DrawnTree* tree : near_) {
    drops += countDrops(*tree, tree_set_.hasLeaves());
    if (count > 0 && drops > MOST_DROPS) break;
    window_ = unite(window_, windowAround(plot_, edge_, shadowOf(*tree)));
    ++count;
  }
  near_.resize(count);
  dropNear(-1.0);
  painted_ = 0;
  done_ = -1;
}

bool MovingShadows::paint(const forest::ForestReplica& replica, Nanoseconds stamp, double seconds) {
  if (stamp == done_) return false;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  if (painted_ == 0) {
    moved_.setDepths(rest_.depths());
    first_ = stamp;
  }
  while (painted_ < near_.size()) {
    const DrawnTree& tree = *near_[painted_++];
    dropTree(tree, replica.pose(tree.tree(), tree.id(), stamp), tree_set_.hasLeaves(), 1.0,
             dropInto(moved_));
    if (Clock::now() >= end && painted_ < near_.size()) return false;
  }
  painted_ = 0;
  done_ = stamp == first_ ? stamp : -1;
  light_ = moved_.light();
  changed_ = unite(changed_, window_);
  return true;
}

Window MovingShadows::takeChanged() {
  const Window out = changed_;
  changed_ = Window();
  return out;
}

}  // namespace vegetation_sim::view
