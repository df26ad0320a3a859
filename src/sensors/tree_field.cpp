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

// Adds the pieces that may be in the ball; those that exceed the limit are left out.
void Trees::addPieces(const forest::ForestReplica& forest, const Vec3& centre, double radius,
                      Known& known, std::vector<std::shared_ptr<PosedTree>>& out) {
  if (forest.broken().empty()) return;
  std::uint32_t id = forest.layout().treeCount();
  for (const forest::PieceKey& key : piecesOf(forest.broken())) {
    const forest::BrokenBranches& broken = brokenOf(forest.broken(), key.tree);
    const forest::BrokenBranch& record = broken[key.number];
    std::shared_ptr<PosedTree>& piece = known[id];
    const forest::TreeSeed seed = seedOf(forest.layout(), key.tree);
    const double reach = seed.scale * sizeBound(forest.layout().species[seed.species]);
    if (length(record.pose.position - centre) <= radius + reach) {
      if (!piece || !piece->isPiece(record)) {
        piece = std::make_shared<PosedTree>(
            forest, id,
            std::make_shared<const forest::FallingPiece>(forest.layout(), forest.terrain(),
                                                         key.tree, broken, key.number));
        ++grown_;
      }
      if (fits(piece->parts())) {
        branches_ += piece->parts();
        out.push_back(std::move(piece));
      } else {
        ++left_out_;
      }
    }
    ++id;
  }
}

void Trees::update(const forest::ForestReplica& forest, const Vec3& centre, double radius,
                   Nanoseconds stamp) {
  ThreadPool alone;
  update(forest, centre, radius, stamp, alone);
}

void Trees::update(const forest::ForestReplica& forest, const Vec3& centre, double radius,
                   Nanoseconds stamp, ThreadPool& threads) {
  auto known = trees_.take();
  if (layout_hash_ != forest.layoutHash()) {
    known.clear();
    sizes_.clear();
  }
  layout_hash_ = forest.layoutHash();
  std::vector<std::shared_ptr<PosedTree>> trees;
  branches_ = 0;
  const std::vector<std::uint32_t> near = nearestFirst(forest, centre, radius);
  const auto fits = [&](std::size_t more) { return trees.empty() || this->fits(more); };
  for (const std::uint32_t id : near) {
    std::shared_ptr<PosedTree>& tree = known[id];
    if (const auto size = sizes_.find(id); size != sizes_.end() && !fits(size->second)) break;
    if (!tree || tree->isOutdated(forest)) {
      tree = std::make_shared<PosedTree>(forest, id);
      ++grown_;
    }
    if (!fits(tree->parts())) {
      sizes_[id] = tree->parts();
      break;
    }
    branches_ += tree->parts();
    trees.push_back(std::move(tree));
  }
  left_out_ = near.size() - trees.size();
  addPieces(forest, centre, radius, known, trees);
  const wind::Instant wind = forest.wind().at(stamp);
  const std::size_t parts = threads.size();
  threads.run(parts, [&](std::size_t first) {
    for (std::size_t i = first; i < trees.size(); i += parts) trees[i]->follow(forest, stamp, wind);
  });
  trees_.set(std::move(trees), centre);
}

}  // namespace vegetation_sim::scan
