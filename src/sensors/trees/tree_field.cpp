// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/trees/tree_field.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <utility>

#include "sensors/geometry/ranked_hit.h"
#include "sensors/traversal/posed_set.h"

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

// Trees that stand still are fitted anew only where a moving sensor enters another cell of a grid,
// and is beyond its border by a quarter of the cell.
Vec3 originNear(const Vec3& place, const Vec3& before) {
  constexpr double CELL = 8.0;  // [m]
  if ((place - before).cwiseAbs().maxCoeff() <= 0.75 * CELL) return before;
  return CELL * (place / CELL).array().round().matrix();
}

}  // namespace

// Adds the pieces in the ball; those that exceed the limit are left out, and are not grown again
// before there is room.
void Trees::addPieces(const forest::ForestReplica& forest, const Vec3& centre, double radius,
                      Nanoseconds stamp) {
  Pieces known = std::exchange(pieces_, {});
  if (forest.broken().empty()) return;
  std::uint32_t next_id = forest.layout().treeCount();
  std::size_t work = 0;
  for (const forest::PieceKey& key : piecesOf(forest.broken())) {
    const std::uint32_t id = next_id++;
    const forest::BrokenBranches& broken = brokenOf(forest.broken(), key.tree);
    const forest::BrokenBranch& record = broken[key.number];
    const forest::TreeSeed seed = seedOf(forest.layout(), key.tree);
    const double size = seed.scale * sizeBound(forest.layout().species[seed.species]);
    if (!forest::FallingPiece::mayReach(record, size, centre, radius)) continue;
    Piece& piece = pieces_[{key.tree, key.number}];
    piece = std::move(known[{key.tree, key.number}]);
    if (!(piece.record == record)) piece = {record, nullptr, 0};
    if (!hasRoom(piece) || (!piece.tree && work >= most_branches_)) {
      piece.tree.reset();
      ++left_out_;
      continue;
    }
    if (!piece.tree || piece.tree->id() != id) {
      const auto falling = std::make_shared<const forest::FallingPiece>(
          forest.layout(), forest.terrain(), key.tree, broken, key.number);
      work += falling->work();
      piece.tree = std::make_shared<PosedTree>(forest, id, falling);
      piece.parts = piece.tree->parts();
      ++grown_;
    }
    if (!piece.tree->isNear(stamp, centre, radius)) continue;
    if (fits(piece.parts)) {
      branches_ += piece.parts;
      trees_.push_back(piece.tree);
    } else {
      piece.tree.reset();
      ++left_out_;
    }
  }
}

void Trees::update(const forest::ForestReplica& forest, const Vec3& centre, double radius,
                   Nanoseconds stamp) {
  ThreadPool alone;
  update(forest, centre, radius, stamp, alone);
}

void Trees::update(const forest::ForestReplica& forest, const Vec3& centre, double radius,
                   Nanoseconds stamp, ThreadPool& threads) {
  auto known = takeById(trees_);
  if (layout_hash_ != forest.layoutHash()) {
    known.clear();
    sizes_.clear();
    pieces_.clear();
  }
  layout_hash_ = forest.layoutHash();
  branches_ = 0;
  const std::vector<std::uint32_t> near = nearestFirst(forest, centre, radius);
  const auto fits = [&](std::size_t more) { return trees_.empty() || this->fits(more); };
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
    trees_.push_back(std::move(tree));
  }
  left_out_ = near.size() - trees_.size();
  addPieces(forest, centre, radius, stamp);
  const wind::Instant wind = forest.wind().at(stamp);
  origin_ = originNear(centre, origin_);
  const std::size_t parts = threads.size();
  threads.run(parts, [&](std::size_t first) {
    for (std::size_t i = first; i < trees_.size(); i += parts)
      trees_[i]->follow(forest, stamp, wind, origin_);
  });
  std::vector<const RodTree*> rods;
  first_ranks_.clear();
  branches_of_.clear();
  std::uint64_t rank = 1;
  for (const auto& tree : trees_) {
    rods.push_back(&tree->rodTree());
    first_ranks_.push_back(rank);
    branches_of_.push_back(tree->branches().data());
    rank += tree->parts();
  }
  rods_.set(rods, origin_, threads);
}

void Trees::meet(const Ray& ray, const FloatRay& narrow, Hit& nearest) const {
  RankedHit ranked(nearest);
  rods_.visit(ray, narrow, nearest, [&](std::size_t tree, std::size_t branch, bool bare) {
    ranked.offer(first_ranks_[tree] + branch,
                 [&](Hit& hit) { return trees_[tree]->meetBranch(branch, ray, hit, bare); });
  });
}

void Trees::meet(const RayBundle& bundle, Hit* nearest) const {
  std::vector<RankedHit> ranked;
  ranked.reserve(RayBundle::MOST_RAYS);
  for (int ray = 0; ray < bundle.count; ++ray) ranked.emplace_back(nearest[ray]);
  const auto fetch = [&](std::size_t tree, std::size_t branch) {
    const auto* place = reinterpret_cast<const char*>(branches_of_[tree] + branch);
    hwy::Prefetch(place);
    hwy::Prefetch(place + sizeof(PosedBranch) / 2);
  };
  rods_.visit(
      bundle, nearest, fetch, [&](int ray, std::size_t tree, std::size_t branch, bool bare) {
        ranked[static_cast<std::size_t>(ray)].offer(first_ranks_[tree] + branch, [&](Hit& hit) {
          return trees_[tree]->meetBranch(branch, bundle.rays[ray], hit, bare);
        });
      });
}

void Trees::addDepth(const Ray& ray, const FloatRay& narrow, LightPath& path) const {
  rods_.visit(ray, narrow, path.end(), [&](std::size_t tree, std::size_t branch, bool bare) {
    trees_[tree]->addBranchDepth(branch, ray, path, bare);
  });
}

}  // namespace vegetation_sim::scan
