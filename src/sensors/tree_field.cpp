// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/tree_field.h"

#include <algorithm>
#include <utility>

namespace vegetation_sim::scan {
namespace {

// Returns the trees that may reach into a ball, nearest first.
std::vector<std::uint32_t> nearestFirst(const forest::ForestReplica& forest, const Vec3& centre,
                                        double radius) {
  std::vector<std::pair<double, std::uint32_t>> sorted;
  for (const std::uint32_t id :
       forest::findTreesNear(forest.layout(), forest.terrain(), centre, radius)) {
    const Vec3 foot = forest::footOf(seedOf(forest.layout(), id), forest.terrain());
    sorted.emplace_back(length(foot - centre), id);
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::uint32_t> out;
  out.reserve(sorted.size());
  for (const auto& entry : sorted) out.push_back(entry.second);
  return out;
}

}  // namespace

void Trees::update(const forest::ForestReplica& forest, const Vec3& centre, double radius,
                   Nanoseconds stamp) {
  ThreadPool alone;
  update(forest, centre, radius, stamp, alone);
}

void Trees::update(const forest::ForestReplica& forest, const Vec3& centre, double radius,
                   Nanoseconds stamp, ThreadPool& threads) {
  std::map<std::uint32_t, std::shared_ptr<PosedTree>> known;
  if (layout_hash_ == forest.layoutHash())
    for (auto& tree : trees_) known[tree->id()] = std::move(tree);
  else
    sizes_.clear();
  layout_hash_ = forest.layoutHash();
  trees_.clear();
  branches_ = 0;
  const std::vector<std::uint32_t> near = nearestFirst(forest, centre, radius);
  const auto fits = [this](std::size_t more) {
    return trees_.empty() || branches_ + more <= most_branches_;
  };
  for (const std::uint32_t id : near) {
    std::shared_ptr<PosedTree>& tree = known[id];
    if (const auto size = sizes_.find(id); size != sizes_.end() && !fits(size->second)) break;
    if (!tree) {
      tree = std::make_shared<PosedTree>(forest, id);
      ++grown_;
    }
    if (!fits(tree->branches())) {
      sizes_[id] = tree->branches();
      break;
    }
    branches_ += tree->branches();
    trees_.push_back(std::move(tree));
  }
  left_out_ = near.size() - trees_.size();
  const wind::Instant wind = forest.wind().at(stamp);
  const std::size_t parts = threads.size();
  threads.run(parts, [&](std::size_t first) {
    for (std::size_t i = first; i < trees_.size(); i += parts)
      trees_[i]->follow(forest, stamp, wind);
  });
  fitBoxes(centre);
}

void Trees::fitBoxes(const Vec3& origin) {
  origin_ = origin;
  std::vector<Box> items;
  items.reserve(trees_.size());
  first_ranks_.clear();
  std::uint64_t rank = 1;
  Box all;
  for (const auto& tree : trees_) {
    const Box box = tree->bounds();
    items.push_back({box.low - origin, box.high - origin});
    all.add(items.back());
    first_ranks_.push_back(rank);
    rank += tree->branches();
  }
  extent_ = extentOf(all);
  boxes_.build(items);
  std::vector<FloatBox> groups;
  for (int group = 0; group < boxes_.groups(); ++group)
    groups.push_back(enclose(items[static_cast<std::size_t>(boxes_.item(group, 0))]));
  boxes_.fit(groups);
}

void Trees::meet(const Ray& ray, const FloatRay& narrow, Hit& nearest) const {
  if (trees_.empty()) return;
  RankedHit ranked(nearest);
  WideWalk walk(boxes_, ray, narrow, origin_, extent_, nearest.distance);
  for (int group = nextGroup(walk); group >= 0; group = nextGroup(walk)) {
    const auto tree = static_cast<std::size_t>(boxes_.item(group, 0));
    trees_[tree]->meet(ray, narrow, first_ranks_[tree], ranked);
    walk.limit = limitOf(nearest.distance);
  }
}

}  // namespace vegetation_sim::scan
