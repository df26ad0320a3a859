// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/mesh/bough_levels.h"

#include <algorithm>

namespace vegetation_sim::forest {
namespace {

double sizeFrom(double distance, const Skeleton& skeleton, const Viewpoint& eye, double factor) {
  return pixelsPerMetre(eye, distance) * skeleton.height * factor;
}

}  // namespace

// Parents come before their children.
Boughs::Boughs(const Skeleton& skeleton) {
  struct Box {
    Vec3 low, high;
  };
  std::vector<Box> boxes;
  for (const Branch& branch : skeleton.branches) {
    const bool is_trunk = branch.depth == 0, is_first = is_trunk || branch.parent < 0;
    const std::int32_t parent =
        is_first ? -1 : of_branches_[static_cast<std::size_t>(branch.parent)];
    const auto bough = parent < 0 && !is_trunk ? static_cast<std::int32_t>(boxes.size()) : parent;
    of_branches_.push_back(bough);
    if (bough < 0) continue;
    const Vec3 foot = branch.rest.position, tip = tipOf(branch, branch.rest);
    if (bough == static_cast<std::int32_t>(boxes.size())) boxes.push_back({foot, foot});
    Box& box = boxes[static_cast<std::size_t>(bough)];
    box = {box.low.cwiseMin(foot).cwiseMin(tip), box.high.cwiseMax(foot).cwiseMax(tip)};
  }
  for (const Box& box : boxes)
    balls_.push_back({0.5 * (box.low + box.high), 0.5 * length(box.high - box.low)});
}

double Boughs::distanceTo(std::size_t bough, const Vec3& place) const {
  return std::max(0.0, length(balls_[bough].centre - place) - balls_[bough].radius);
}

bool operator==(const TreeLevels& a, const TreeLevels& b) {
  return a.trunk == b.trunk && a.boughs == b.boughs;
}

TreeLevels treeLevels(const Skeleton& skeleton, const Boughs& boughs, const Vec3& foot,
                      const Viewpoint& eye, double factor, bool by_bough,
                      const TreeLevels& current) {
  const Vec3 place = eye.position - foot;
  const double middle = length(Vec3(0.0, 0.0, 0.5 * skeleton.height) - place);
  const double nearest = middle - skeleton.reach;
  TreeLevels out;
  out.trunk = geometryLevel(sizeFrom(nearest, skeleton, eye, factor), current.trunk);
  const double limit = current.boughs.empty() ? DISTANCE_OF_BOUGHS : LAST_DISTANCE_OF_BOUGHS;
  if (!by_bough || middle > limit * skeleton.reach) return out;
  out.boughs.resize(boughs.size());
  bool differ = false;
  for (std::size_t i = 0; i < boughs.size(); ++i) {
    const int before = current.boughs.empty() ? current.trunk : current.boughs[i];
    const double size = sizeFrom(boughs.distanceTo(i, place), skeleton, eye, factor);
    out.boughs[i] = std::min(out.trunk, geometryLevel(size, before));
    differ = differ || out.boughs[i] != out.trunk;
  }
  if (!differ) out.boughs.clear();
  return out;
}

int TreeMeshDetail::depths() const {
  int out = trunk.depths;
  for (const MeshDetail& detail : boughs) out = std::max(out, detail.depths);
  return out;
}

TreeMeshDetail treeMeshDetail(const Boughs& boughs, const TreeLevels& levels) {
  TreeMeshDetail out;
  out.trunk = meshDetail(levels.trunk);
  if (levels.boughs.empty()) return out;
  for (const int level : levels.boughs) out.boughs.push_back(meshDetail(level));
  out.of_branches = boughs.ofBranches();
  return out;
}

}  // namespace vegetation_sim::forest
