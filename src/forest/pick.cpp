// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/pick.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

struct Closest {
  double on_ray, on_axis, distance;
};

// Nearest points of a ray (unit direction) and an axis of given length (unit direction).
Closest nearest(const Vec3& origin, const Vec3& direction, const Vec3& base, const Vec3& axis,
                double axis_length) {
  const Vec3 between = base - origin;
  const double b = dot(direction, axis), d = dot(direction, between), e = dot(axis, between);
  const double denominator = 1.0 - b * b;
  double s = denominator > 1e-12 ? (b * d - e) / denominator : 0.0;
  s = std::clamp(s, 0.0, axis_length);
  const double t = std::max(0.0, d + s * b);
  s = std::clamp(t * b - e, 0.0, axis_length);
  return {t, s, length(origin + t * direction - base - s * axis)};
}

// True if the ray passes within `reach` of a point.
bool passes(const Ray& ray, const Vec3& direction, const Vec3& centre, double reach) {
  const Vec3 offset = centre - ray.origin;
  const double t = std::max(0.0, dot(offset, direction));
  return length(offset - t * direction) <= reach;
}

/// Distance at which a ray may first meet a tree [m], and the tree.
using Candidate = std::pair<double, std::uint32_t>;

void addCandidate(const Layout& layout, const terrain::HeightMap& terrain, const Ray& ray,
                  std::uint32_t id, const TreeSeed& seed, std::vector<Candidate>& out) {
  const Vec3 direction = ray.direction / length(ray.direction);
  const double reach = seed.scale * sizeBound(layout.species[seed.species]) + ray.tolerance;
  const Vec3 foot = footOf(seed, terrain);
  if (passes(ray, direction, foot, reach))
    out.emplace_back(std::max(0.0, dot(foot - ray.origin, direction) - reach), id);
}

// Heights inside the tile are unknown: a tall cylinder, tested in the plane.
bool passesTile(const Ray& ray, const Vec3& direction, const Tile& tile, double tree_size) {
  const double x = tile.x + 0.5 * tile.size, y = tile.y + 0.5 * tile.size;
  const Vec3 flat(direction.x(), direction.y(), 0.0);
  const double across = length(flat);
  const Vec3 offset(x - ray.origin.x(), y - ray.origin.y(), 0.0);
  const double t = across > 1e-9 ? std::max(0.0, dot(offset, flat) / (across * across)) : 0.0;
  return length(offset - t * flat) <= 0.75 * tile.size + tree_size + ray.tolerance;
}

}  // namespace

std::optional<Picked> pickBranch(const Tree& tree, const std::vector<Pose>& poses, const Ray& ray) {
  const Vec3 direction = ray.direction / length(ray.direction);
  std::optional<Picked> best;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Branch& branch = tree.skeleton.branches[i];
    const Vec3 base = tree.foot + poses[i].position, axis = axisZ(poses[i].orientation);
    const Closest hit = nearest(ray.origin, direction, base, axis, branch.length);
    const double f = hit.on_axis / branch.length;
    const double radius = branch.base_radius + (branch.tip_radius - branch.base_radius) * f;
    if (hit.distance > radius + ray.tolerance) continue;
    if (best && best->distance <= hit.on_ray) continue;
    best = Picked{0, static_cast<int>(i), hit.on_axis, hit.on_ray, Vec3(base + hit.on_axis * axis)};
  }
  return best;
}

std::optional<Picked> pickTree(const Layout& layout, const terrain::HeightMap& terrain,
                               const Ray& ray,
                               const std::function<PosedTree(std::uint32_t)>& posed) {
  const Vec3 direction = ray.direction / length(ray.direction);
  std::vector<Candidate> candidates;
  for (std::uint32_t i = 0; i < layout.trees.size(); ++i)
    addCandidate(layout, terrain, ray, i, layout.trees[i], candidates);
  double largest = 0.0;
  for (const Species& species : layout.species) largest = std::max(largest, sizeBound(species));
  for (const Tile& tile : layout.tiles) {
    if (!passesTile(ray, direction, tile, LARGEST_TILED_SCALE * largest)) continue;
    for (std::uint32_t i = 0; i < tile.count; ++i)
      addCandidate(layout, terrain, ray, tile.first_tree + i, seedInTile(tile, i), candidates);
  }
  // Nearest first: once a branch is met, trees that begin behind it need no growing.
  std::sort(candidates.begin(), candidates.end());
  std::optional<Picked> best;
  for (const auto& [nearest_distance, id] : candidates) {
    if (best && best->distance < nearest_distance) break;
    const PosedTree tree = posed(id);
    std::optional<Picked> hit = pickBranch(*tree.tree, tree.poses, ray);
    if (!hit || (best && best->distance <= hit->distance)) continue;
    hit->tree = id;
    best = hit;
  }
  return best;
}

}  // namespace vegetation_sim::forest
