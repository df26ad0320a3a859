// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/markers/forest_markers.h"

#include <algorithm>
#include <cmath>

#include "tree/mesh/skin.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/tree/motion/batch_poser.h"

namespace vegetation_sim {
namespace {

constexpr double SMALLEST_PX = 3.0;        // smallest height of a drawn tree
constexpr std::size_t LEAST_POINTS = 120;  // for each drawn tree

Vec3 pointAt(const std::vector<float>& xyz, std::size_t vertex) {
  return Vec3(xyz[3 * vertex], xyz[3 * vertex + 1], xyz[3 * vertex + 2]);
}

Vec3 middleOf(const forest::Layout& layout) {
  Vec3 sum = Vec3::Zero();
  double count = 0.0;
  for (const forest::TreeSeed& seed : layout.trees) {
    sum += seed.position;
    count += 1.0;
  }
  for (const forest::Tile& tile : layout.tiles) {
    sum += static_cast<double>(tile.count) *
           Vec3(tile.x + 0.5 * tile.size, tile.y + 0.5 * tile.size, 0.0);
    count += tile.count;
  }
  return count > 0.0 ? Vec3(sum / count) : sum;
}

/// Tiles with the largest height [pixel] that any tree of theirs may have, largest first.
std::vector<std::pair<double, const forest::Tile*>> tilesInOrder(
    const forest::Forest& forest, const std::vector<Viewpoint>& viewers) {
  double tallest = 0.0;
  for (const forest::Species& species : forest.layout().species)
    tallest = std::max(tallest, forest::LARGEST_TILED_SCALE * species.height);
  std::vector<std::pair<double, const forest::Tile*>> out;
  for (const forest::Tile& tile : forest.layout().tiles) {
    if (!forest.owners().owns(tile.first_tree)) continue;
    const double x = tile.x + 0.5 * tile.size, y = tile.y + 0.5 * tile.size;
    const Vec3 middle(x, y, forest.terrain().height(x, y));
    out.emplace_back(tallest * largestScale(viewers, middle, 0.75 * tile.size), &tile);
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  return out;
}

}  // namespace

ForestMarkers::ForestMarkers(const forest::Forest& forest, forest::TreeCache& cache, int points)
    : forest_(forest), cache_(cache) {
  const auto half = static_cast<std::size_t>(points) / 2;
  lists_.addList(namespaceOf("bark", forest.shard()), half / 3 * 3);
  lists_.addList(namespaceOf("leaves", forest.shard()), half / 6 * 6);
}

void ForestMarkers::reset() {
  drawn_.clear();
  feedback_.reset();
}

void ForestMarkers::chooseTrees(std::vector<Viewpoint> viewers) {
  const forest::Layout& layout = forest_.layout();
  if (viewers.empty()) viewers.push_back({middleOf(layout)});
  const std::size_t most = lists_.budget() / LEAST_POINTS;
  order_.clear();
  const auto consider = [&](std::uint32_t id, const forest::TreeSeed& seed) {
    const double view = largestScale(viewers, footOf(seed, forest_.terrain()));
    const double height = seed.scale * layout.species[seed.species].height;
    if (view * height >= SMALLEST_PX) order_.emplace_back(view * height, id);
  };
  for (std::uint32_t i = 0; i < layout.trees.size(); ++i)
    if (forest_.owners().owns(i)) consider(i, layout.trees[i]);
  for (const auto& [largest, tile] : tilesInOrder(forest_, viewers)) {
    keepLargest(most);
    if (largest < least_) break;
    for (std::uint32_t i = 0; i < tile->count; ++i)
      consider(tile->first_tree + i, seedInTile(*tile, i));
  }
  keepLargest(most);
  std::sort(order_.begin(), order_.end(), std::greater<>());
}

void ForestMarkers::keepLargest(std::size_t count) {
  least_ = SMALLEST_PX;
  if (count == 0 || order_.size() <= count) return;
  const auto last = order_.begin() + static_cast<std::ptrdiff_t>(count) - 1;
  std::nth_element(order_.begin(), last, order_.end(), std::greater<>());
  order_.resize(count);
  least_ = order_.back().first;
}

void ForestMarkers::addTree(std::uint32_t id, Nanoseconds stamp) {
  const auto grown = cache_.get(forest_, id);
  const forest::Species& species = forest_.layout().species[grown->tree.seed.species];
  const forest::TreeMesh& mesh = *drawn_[id].mesh;
  wanted_bark_ += mesh.triangles.size();
  wanted_leaves_ += 6 * mesh.leaves.size();
  if (!lists_.hasRoom(BARK, mesh.triangles.size()) ||
      !lists_.hasRoom(LEAVES, 6 * mesh.leaves.size()))
    return;
  const wind::Instant wind = forest_.snapshot().wind.at(stamp).relativeTo(grown->tree.foot);
  const forest::Weights weights =
      forest::weightsAt(forest_.view().levels.of(id), stamp, forest_.layout().motion);
  const forest::ModalTreeState* modal_state = forest_.view().modes.find(id);
  const bool physical = !forest_.promoted(id).branches.empty();
  if (!physical && modal_state && forest::modalWeight(weights) >= 1.0)
    modal_state->pose(grown->poser, stamp, poses_);
  else if (!physical && !modal_state)
    grown->poser.pose(wind, weights, forest::MAX_DEPTHS, poses_);
  else
    narrowPoses(forest_.poseInView(grown->tree, id, stamp), poses_);
  const std::array<float, 3> foot{static_cast<float>(grown->tree.foot.x()),
                                  static_cast<float>(grown->tree.foot.y()),
                                  static_cast<float>(grown->tree.foot.z())};
  scratch_.resize(3 * mesh.bark.size());
  skinBark(mesh, poses_, foot, scratch_.data());
  for (const std::uint32_t vertex : mesh.triangles) {
    const auto branch = static_cast<std::size_t>(mesh.bark[vertex].branch);
    const bool trunk = grown->tree.skeleton.branches[branch].depth == 0;
    lists_.add(BARK, pointAt(scratch_, vertex),
               opaque(trunk ? species.bark_colour : species.twig_colour));
  }
  const double speed = length(wind.velocity(Vec3(0.0, 0.0, 0.5 * grown->tree.skeleton.height)));
  const forest::Flutter flutter(static_cast<double>(stamp % (3600 * NANOSECONDS_PER_SECOND)) * 1e-9,
                                speed, species.flutter);
  scratch_.resize(12 * mesh.leaves.size());
  skinLeaves(mesh, poses_, foot, flutter, scratch_.data());
  for (std::size_t i = 0; i < mesh.leaves.size(); ++i) {
    const double shade = mesh.leaves[i].shade;
    const auto paint =
        opaque(species.leaf_colour * (1.0 - shade) + species.leaf_colour_young * shade);
    for (const std::uint32_t corner : forest::LEAF_TRIANGLES)
      lists_.add(LEAVES, pointAt(scratch_, 4 * i + corner), paint);
  }
}

void ForestMarkers::build(const std::vector<Viewpoint>& viewers, Nanoseconds stamp) {
  chooseTrees(viewers);
  lists_.clear(BARK);
  lists_.clear(LEAVES);
  wanted_bark_ = wanted_leaves_ = 0;
  std::map<std::uint32_t, Drawn> drawn;
  for (const auto& [height_px, id] : order_) {
    Drawn& entry = drawn[id] = drawn_[id];
    const int level = forest::geometryLevel(height_px * feedback_.factor(), entry.level);
    const forest::BrokenBranches& broken = brokenOf(forest_.broken(), id);
    if (level != entry.level || !entry.mesh || !(entry.broken == broken)) {
      const auto grown = cache_.get(forest_, id);
      entry.level = level;
      entry.broken = broken;
      entry.mesh = std::make_shared<const forest::TreeMesh>(
          buildMesh(grown->tree.skeleton, forest_.layout().species[grown->tree.seed.species],
                    forest::meshDetail(level)));
    }
    drawn_[id] = entry;
    addTree(id, stamp);
  }
  drawn_ = std::move(drawn);
  // The fuller of the two lists counts, so that trees keep their leaves.
  feedback_.update(2.0 * static_cast<double>(std::max(wanted_bark_, wanted_leaves_)),
                   0.85 * static_cast<double>(lists_.budget()));
}

}  // namespace vegetation_sim
