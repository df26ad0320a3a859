// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/posed_tree.h"

#include <cmath>

#include "sensors/geometry/beer_lambert.h"
#include "tree/mesh/mesh.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/tree/motion/batch_poser.h"

namespace vegetation_sim::scan {
namespace {

constexpr double MEAN_COSINE = 0.5;  // mean over leaves of random orientation

}  // namespace

PosedTree::PosedTree(const forest::ForestReplica& forest, std::uint32_t id)
    : id_(id), tree_(forest.grow(id)), poser_(tree_) {
  const std::vector<forest::Branch>& branches = tree_.skeleton.branches;
  rods_.resize(branches.size());
  for (std::size_t i = 0; i < branches.size(); ++i) {
    rods_[i].length = branches[i].length;
    rods_[i].base_radius = branches[i].base_radius;
    rods_[i].tip_radius = branches[i].tip_radius;
  }
  addLeaves(forest.layout().species.at(tree_.seed.species));
  poser_.pose(wind::Instant(), forest::Weights{}, tree_.skeleton.depths(), poses_);
  fitBoxes();
  boxes_.build(items_);
}

// The leaf clusters of a twig are spread evenly over their reach.
void PosedTree::addLeaves(const forest::Species& species) {
  const std::vector<forest::Branch>& branches = tree_.skeleton.branches;
  leaves_.resize(branches.size());
  if (branches.empty()) return;
  const double scale = std::sqrt(branches[0].base_radius / species.trunk_radius);
  const double edge = species.leaf_size * scale, radius = LEAF_REACH * edge;
  for (std::size_t i = 0; i < branches.size(); ++i) {
    if (branches[i].leaves == 0 || radius <= 0.0) continue;
    const double volume = PI * radius * radius * (branches[i].length + 4.0 / 3.0 * radius);
    const double area = forest::LEAF_COVERAGE * edge * edge * branches[i].leaves;
    leaves_[i] = {radius, LEAF_PROJECTION * area / volume,
                  static_cast<std::uint32_t>(branches[i].key >> 32)};
  }
}

void PosedTree::fitBoxes() {
  items_.resize(rods_.size());
  for (std::size_t i = 0; i < rods_.size(); ++i) {
    const Pose pose = poses_.at(static_cast<int>(i));
    Rod& rod = rods_[i];
    rod.base = tree_.foot + pose.position;
    rod.axis = axisZ(pose.orientation);
    items_[i] = boxOf(rod);
    items_[i].add(rod.base, leaves_[i].radius);
    items_[i].add(rod.base + rod.length * rod.axis, leaves_[i].radius);
  }
}

void PosedTree::pose(const forest::ForestReplica& forest, Nanoseconds stamp,
                     const wind::Instant& wind) {
  if (forest.modalState(id_) || !forest.promoted(id_).branches.empty())
    narrowPoses(forest.pose(tree_, id_, stamp), poses_);
  else
    poser_.pose(wind.relativeTo(tree_.foot), forest.weights(id_, stamp), tree_.skeleton.depths(),
                poses_);
  fitBoxes();
  boxes_.refit(items_);
}

void PosedTree::follow(const forest::ForestReplica& forest, Nanoseconds stamp,
                       const wind::Instant& wind) {
  const bool moves = forest::movingDepths(forest.weights(id_, stamp)) > 0 ||
                     forest.modalState(id_) != nullptr || !forest.promoted(id_).branches.empty();
  if (moves || moved_) pose(forest, stamp, wind);
  moved_ = moves;
}

void PosedTree::meet(const Ray& ray, Hit& nearest) const {
  boxes_.visit(ray, nearest, [&](std::size_t branch) { meetBranch(branch, ray, nearest); });
}

void PosedTree::meetBranch(std::size_t branch, const Ray& ray, Hit& nearest) const {
  Meeting meeting;
  if (scan::meet(ray, rods_[branch], nearest.distance, meeting)) {
    const bool trunk = tree_.skeleton.branches[branch].depth == 0;
    nearest = {meeting.distance, trunk ? Label::TRUNK : Label::BRANCH, id_,
               static_cast<int>(branch), meeting.cosine};
  }
  if (leaves_[branch].radius > 0.0) meetLeaves(branch, ray, nearest);
}

// The cells are fixed to the branch, so that leaves move with it.
void PosedTree::meetLeaves(std::size_t branch, const Ray& ray, Hit& nearest) const {
  const Leaves& leaves = leaves_[branch];
  const Stretch part = within(ray, rods_[branch], leaves.radius);
  if (!(part.from < part.to && part.from < nearest.distance)) return;
  const Quat turn = poses_.at(static_cast<int>(branch)).orientation;
  const Vec3 place = rotate(conjugate(turn), Vec3(ray.at(part.from) - rods_[branch].base));
  const double way = depthOf(cellAt(place, LEAF_CELL), leaves.key) / leaves.extinction;
  if (!(part.from + way < std::min(part.to, nearest.distance))) return;
  nearest = {part.from + way, Label::LEAF, id_, static_cast<int>(branch), MEAN_COSINE};
}

}  // namespace vegetation_sim::scan
