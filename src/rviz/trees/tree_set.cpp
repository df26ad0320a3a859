// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/trees/tree_set.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace vegetation_sim::view {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double LIGHT_CELL = 0.8;  // [m]
constexpr double MARGIN = 12.0;     // [m] of the light grid around the trees

struct Candidate {
  double distance;
  std::uint32_t id;
};

double distanceTo(const forest::Tile& tile, const Vec3& point) {
  const double half = 0.5 * tile.size;
  const double x = std::max(0.0, std::fabs(point.x() - tile.x - half) - half);
  const double y = std::max(0.0, std::fabs(point.y() - tile.y - half) - half);
  return std::sqrt(x * x + y * y);
}

// The nearest trees of a tile: `most` or all, and the distance that contains them [m].
double addTile(const forest::Tile& tile, const Vec3& point, std::size_t most,
               std::vector<Candidate>& out) {
  const std::size_t before = out.size();
  const double least = distanceTo(tile, point), all = least + 1.5 * tile.size;
  double way = tile.size * std::sqrt(static_cast<double>(most) / std::max(1u, tile.count));
  for (;; way *= 2.0) {
    out.resize(before);
    const double radius = std::min(all, least + way);
    std::size_t within = 0;
    for (const std::uint32_t t : forest::findTreesInTile(tile, point, radius)) {
      const Vec3 at = forest::seedInTile(tile, t).position - point;
      out.push_back({std::hypot(at.x(), at.y()), tile.first_tree + t});
      within += out.back().distance <= radius;
    }
    if (within >= most || radius == all) return radius;
  }
}

// Visits the nearest tiles first, until no other tile can contain one of the `most` nearest trees.
void addTiles(const forest::Layout& layout, const Vec3& point, std::size_t most,
              std::vector<Candidate>& out) {
  std::vector<std::size_t> order(layout.tiles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return distanceTo(layout.tiles[a], point) < distanceTo(layout.tiles[b], point);
  });
  const std::size_t explicit_trees = out.size();
  double enough = -1.0, farthest = 0.0;  // [m] `most` trees are within `enough`
  for (const std::size_t i : order) {
    const forest::Tile& tile = layout.tiles[i];
    if (enough >= 0.0 && distanceTo(tile, point) > enough) return;
    farthest = std::max(farthest, addTile(tile, point, most, out));
    if (enough < 0.0 && out.size() >= explicit_trees + most) enough = farthest;
  }
}

}  // namespace

bool View::sees(const Vec3& centre, double radius) const {
  const Vec3 to = centre - eye.position;
  const double distance = length(to);
  if (distance <= radius) return true;
  const double beside = std::asin(std::min(1.0, radius / distance));
  return dot(to, forward) >= distance * std::cos(std::min(3.14, half_angle + beside));
}

std::vector<std::uint32_t> nearestTrees(const forest::Layout& layout, const Vec3& point,
                                        std::size_t most) {
  std::vector<std::uint32_t> out;
  if (layout.treeCount() <= most) {
    out.resize(layout.treeCount());
    std::iota(out.begin(), out.end(), 0u);
    return out;
  }
  std::vector<Candidate> candidates;
  for (std::uint32_t i = 0; i < layout.trees.size(); ++i) {
    const Vec3 at = layout.trees[i].position - point;
    candidates.push_back({std::hypot(at.x(), at.y()), i});
  }
  addTiles(layout, point, most, candidates);
  const auto end =
      candidates.begin() + static_cast<std::ptrdiff_t>(std::min(most, candidates.size()));
  std::partial_sort(candidates.begin(), end, candidates.end(),
                    [](const Candidate& a, const Candidate& b) {
                      return a.distance != b.distance ? a.distance < b.distance : a.id < b.id;
                    });
  for (auto it = candidates.begin(); it != end; ++it) out.push_back(it->id);
  std::sort(out.begin(), out.end());
  return out;
}

TreeSet::TreeSet(const forest::ForestReplica& replica, std::vector<std::uint32_t> ids)
    : ids_(std::move(ids)), origin_(Vec3::Zero()) {
  for (const std::uint32_t id : ids_)
    origin_ += forest::seedOf(replica.layout(), id).position / static_cast<double>(ids_.size());
  origin_.z() = replica.terrain().height(origin_.x(), origin_.y());
}

bool TreeSet::grow(const forest::ForestReplica& replica, const Vec3& to_sun, bool leaves,
                   double seconds) {
  if (ready()) return true;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (trees_.size() < ids_.size()) {
    trees_.push_back(std::make_unique<DrawnTree>(replica, ids_[trees_.size()], origin_));
    if (Clock::now() >= end) return false;
  }
  castLight(to_sun, leaves);
  return true;
}

const DrawnTree* TreeSet::find(std::uint32_t id) const {
  const auto found = std::lower_bound(ids_.begin(), ids_.end(), id);
  if (found == ids_.end() || *found != id) return nullptr;
  const auto place = static_cast<std::size_t>(found - ids_.begin());
  return place < trees_.size() ? trees_[place].get() : nullptr;
}

void TreeSet::castLight(const Vec3& to_sun, bool leaves) {
  leaves_ = leaves;
  extent_ = {origin_, origin_ + Vec3(0.0, 0.0, 1.0)};
  for (const auto& tree : trees_) {
    const Vec3 around(tree->reach(), tree->reach(), 0.0), up(0.0, 0.0, tree->height());
    extent_.low = extent_.low.cwiseMin(tree->foot() - around);
    extent_.high = extent_.high.cwiseMax(tree->foot() + around + up);
  }
  const Vec3 margin(MARGIN, MARGIN, 1.0);
  auto light =
      std::make_shared<forest::LightGrid>(extent_.low - margin, extent_.high + margin, LIGHT_CELL);
  if (leaves)
    for (const auto& tree : trees_) tree->addTo(*light);
  light->cast(to_sun);
  light_ = std::move(light);
}

}  // namespace vegetation_sim::view
