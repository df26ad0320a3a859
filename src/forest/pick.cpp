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

constexpr std::size_t MOST_PICKED = 1000000;  // branches of trees that a ray passes before a hit

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

// Adds the trees of a tile that may stand within `reach` of the ray in the plane, sorted. Pieces of
// the ray keep the number of others small that are visited.
std::vector<std::uint32_t> findTreesAlong(const Tile& tile, const Ray& ray, const Vec3& direction,
                                          double reach) {
  constexpr double PIECES = 64.0;  // of a ray through the whole tile
  const Vec3 flat(direction.x(), direction.y(), 0.0);
  const double across = length(flat);
  if (across < 1e-9) return findTreesInTile(tile, ray.origin, reach);
  const Vec3 along = flat / across;
  const Vec3 offset(tile.x + 0.5 * tile.size - ray.origin.x(),
                    tile.y + 0.5 * tile.size - ray.origin.y(), 0.0);
  const double middle = dot(offset, along), aside = length(offset - middle * along);
  const double radius = 0.75 * tile.size + reach;
  std::vector<std::uint32_t> out;
  if (aside > radius) return out;
  const double half = std::sqrt(radius * radius - aside * aside), end = middle + half;
  const double piece = std::max(2.0 * reach, tile.size / PIECES);
  for (double from = std::max(0.0, middle - half); from <= end; from += piece) {
    const Vec3 centre = ray.origin + (from + 0.5 * piece) * along;
    const auto found =
        findTreesInTile(tile, centre, std::sqrt(0.25 * piece * piece + reach * reach));
    out.insert(out.end(), found.begin(), found.end());
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace

std::optional<Picked> pickBranch(const Tree& tree, const std::vector<Pose>& poses, const Ray& ray) {
  const Vec3 direction = ray.direction / length(ray.direction);
  std::optional<Picked> best;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Branch& branch = tree.skeleton.branches[i];
    if (branch.broken) continue;
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
  for (const Tile& tile : layout.tiles)
    for (const std::uint32_t i :
         findTreesAlong(tile, ray, direction, LARGEST_TILED_SCALE * largest + ray.tolerance))
      addCandidate(layout, terrain, ray, tile.first_tree + i, seedInTile(tile, i), candidates);
  // Nearest first: once a branch is met, trees that begin behind it need no growing.
  std::sort(candidates.begin(), candidates.end());
  std::optional<Picked> best;
  std::size_t branches = 0;
  for (const auto& [nearest_distance, id] : candidates) {
    if (best && best->distance < nearest_distance) break;
    if (branches > MOST_PICKED)
      throw InvalidInput("the ray passes more trees than are searched at once: it meets none of " +
                         std::to_string(branches) + " branches");
    const PosedTree tree = posed(id);
    branches += tree.poses.size();
    std::optional<Picked> hit = pickBranch(*tree.tree, tree.poses, ray);
    if (!hit || (best && best->distance <= hit->distance)) continue;
    hit->tree = id;
    best = hit;
  }
  return best;
}

}  // namespace vegetation_sim::forest
