// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/trees/posed_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sensors/media/beer_lambert.h"
#include "tree/mesh/bark_mesh.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/tree/motion/batch_poser.h"

namespace vegetation_sim::scan {

PosedTree::PosedTree(const forest::ForestReplica& forest, std::uint32_t id)
    : PosedTree(forest, id, forest.grow(id), nullptr) {
  broken_ = brokenOf(forest.broken(), id);
}

PosedTree::PosedTree(const forest::ForestReplica& forest, std::uint32_t id,
                     std::shared_ptr<const forest::FallingPiece> piece)
    : PosedTree(forest, id, piece->tree(), piece) {}

PosedTree::PosedTree(const forest::ForestReplica& forest, std::uint32_t id, forest::Tree tree,
                     std::shared_ptr<const forest::FallingPiece> piece)
    : id_(id),
      piece_(std::move(piece)),
      tree_(std::move(tree)),
      paint_(forest.layout().species.at(tree_.seed.species), tree_.seed.seed),
      poser_(tree_),
      origin_(tree_.foot) {
  const std::vector<forest::Branch>& grown = tree_.skeleton.branches;
  branches_.resize(grown.size());
  for (std::size_t i = 0; i < grown.size(); ++i) {
    branches_[i].rod.length = grown[i].length;
    branches_[i].rod.base_radius = grown[i].base_radius;
    branches_[i].rod.tip_radius = grown[i].tip_radius;
    branches_[i].trunk = grown[i].depth == 0;
    branches_[i].gone = grown[i].broken;
  }
  addLeaves(forest.layout().species.at(tree_.seed.species));
  if (piece_)
    narrowPoses(piece_->poseAt(piece_->record().stamp), poses_);
  else
    poser_.pose(wind::Instant(), forest::Weights{}, tree_.skeleton.depths(), poses_);
  placeRods();
  rod_tree_.build(
      parts(), [this](std::size_t i) { return roomyRod(i); }, origin_);
}

// The leaf clusters of a twig are spread evenly over their reach.
void PosedTree::addLeaves(const forest::Species& species) {
  const std::vector<forest::Branch>& branches = tree_.skeleton.branches;
  const double scale = std::sqrt(tree_.skeleton.trunk_radius / species.trunk_radius);
  const double edge = species.leaf_size * scale, radius = LEAF_REACH * edge;
  for (std::size_t i = 0; i < branches.size(); ++i) {
    if (branches[i].leaves == 0 || radius <= 0.0) continue;
    const double volume = PI * radius * radius * (branches[i].length + 4.0 / 3.0 * radius);
    const double area = forest::LEAF_COVERAGE * edge * edge * branches[i].leaves;
    branches_[i].leaf_radius = radius;
    branches_[i].extinction = LEAF_PROJECTION * area / volume;
    branches_[i].leaf_key = static_cast<std::uint32_t>(branches[i].key >> 32);
    largest_leaves_ = std::max(largest_leaves_, radius);
  }
}

void PosedTree::placeRods() {
  for (std::size_t i = 0; i < branches_.size(); ++i) {
    const Pose pose = poses_.at(static_cast<int>(i));
    PosedBranch& branch = branches_[i];
    branch.rod.base = tree_.foot + pose.position;
    branch.rod.axis = axisZ(pose.orientation);
    branch.turn = pose.orientation;
  }
}

void PosedTree::pose(const forest::ForestReplica& forest, Nanoseconds stamp,
                     const wind::Instant& wind) {
  if (forest.modalState(id_) || !forest.promoted(id_).branches.empty())
    narrowPoses(forest.pose(tree_, id_, stamp), poses_);
  else
    poser_.pose(wind.relativeTo(tree_.foot), forest.weights(id_, stamp), tree_.skeleton.depths(),
                poses_);
  placeRods();
}

void PosedTree::posePiece(Nanoseconds stamp) {
  narrowPoses(piece_->poseAt(stamp), poses_);
  placeRods();
}

bool PosedTree::isNear(Nanoseconds stamp, const Vec3& centre, double radius) const {
  return length(piece_->placeAt(stamp) - centre) <= radius + piece_->reach() + largest_leaves_;
}

void PosedTree::fit(bool moved, const Vec3& origin) {
  if (moved || origin_ != origin)
    rod_tree_.fit([this](std::size_t i) { return roomyRod(i); }, origin);
  origin_ = origin;
}

void PosedTree::follow(const forest::ForestReplica& forest, Nanoseconds stamp,
                       const wind::Instant& wind, const Vec3& origin) {
  if (piece_) {
    const bool falls = stamp < piece_->restsFrom();
    if (falls || moved_) posePiece(stamp);
    fit(falls || moved_, origin);
    moved_ = falls;
    return;
  }
  const bool moves = forest::movingDepths(forest.weights(id_, stamp)) > 0 ||
                     forest.modalState(id_) != nullptr || !forest.promoted(id_).branches.empty();
  if (moves || moved_) pose(forest, stamp, wind);
  fit(moves || moved_, origin);
  moved_ = moves;
}

std::size_t PosedTree::partOf(int branch) const {
  if (!piece_) return static_cast<std::size_t>(branch);
  const std::vector<int>& own = piece_->branches();
  return static_cast<std::size_t>(std::lower_bound(own.begin(), own.end(), branch) - own.begin());
}

bool PosedTree::meetBranch(std::size_t index, const Ray& ray, Hit& nearest, bool wood) const {
  const PosedBranch& branch = branches_[index];
  if (branch.gone) return false;
  Meeting meeting;
  const bool met = wood && scan::meet(ray, branch.rod, nearest.distance, meeting);
  if (met) {
    nearest = {meeting.distance, branch.trunk ? Label::TRUNK : Label::BRANCH, id_, branchOf(index),
               meeting.cosine};
  }
  const bool leaves = branch.leaf_radius > 0.0 && meetLeaves(index, ray, nearest);
  return met || leaves;
}

// The cells are fixed to the branch, so that leaves move with it.
bool PosedTree::meetLeaves(std::size_t index, const Ray& ray, Hit& nearest) const {
  const PosedBranch& branch = branches_[index];
  const Stretch part = within(ray, branch.rod, branch.leaf_radius);
  if (!(part.from < part.to && part.from < nearest.distance)) return false;
  const Vec3 place = rotate(conjugate(branch.turn), Vec3(ray.at(part.from) - branch.rod.base));
  const double to = std::min(part.to, nearest.distance);
  const double share = shareOf(cellAt(place, LEAF_CELL), branch.leaf_key);
  if (!mayBeBelow(branch.extinction * (to - part.from), share)) return false;
  const double way = depthAt(share) / branch.extinction;
  if (!(part.from + way < to)) return false;
  nearest = {part.from + way, Label::LEAF, id_, branchOf(index), LEAF_COSINE};
  return true;
}

void PosedTree::addBranchDepth(std::size_t index, const Ray& ray, LightPath& path,
                               bool wood) const {
  const PosedBranch& branch = branches_[index];
  if (path.isBlocked() || branch.gone) return;
  Meeting meeting;
  if (wood && scan::meet(ray, branch.rod, path.end().distance, meeting)) return path.block();
  if (!(branch.leaf_radius > 0.0)) return;
  const Stretch part = within(ray, branch.rod, branch.leaf_radius);
  const double way = std::min(part.to, path.end().distance) - part.from;
  if (way > 0.0) path.add(branch.extinction * way);
}

}  // namespace vegetation_sim::scan
