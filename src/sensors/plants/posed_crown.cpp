// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/plants/posed_crown.h"

#include "sensors/plants/leaf_strip.h"

namespace vegetation_sim::scan {

PosedCrown::PosedCrown(const CrownSource& source)
    : tree_(source.tree),
      origin_(source.rest->empty() ? Vec3(Vec3::Zero()) : source.rest->front().pose.position) {
  for (const canopy::CrownLeaf& each : *source.leaves) {
    branches_.push_back(static_cast<int>(each.twig));
    strips_.push_back(stripOf(each.leaf, {each.leaf.root, each.leaf.tip, each.leaf.side}));
  }
  strip_tree_.build(strips_, origin_);
}

void PosedCrown::pose(const CrownSource& source, const canopy::Foliage& foliage) {
  const std::vector<Pose> wood = source.wood();
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    const canopy::CrownLeaf& leaf = (*source.leaves)[i];
    strips_[i] =
        stripOf(leaf.leaf, carry(foliage, leaf, (*source.rest)[leaf.twig].pose, wood[leaf.twig]));
  }
  strip_tree_.fit(strips_, origin_);
}

void PosedCrown::meet(const Ray& ray, const FloatRay& narrow, std::uint64_t first_rank,
                      RankedHit& nearest) const {
  strip_tree_.visit(ray, narrow, nearest.hit(), [&](std::size_t leaf) {
    nearest.offer(first_rank + leaf, [&](Hit& hit) { return meetLeaf(leaf, ray, hit); });
  });
}

bool PosedCrown::meetLeaf(std::size_t leaf, const Ray& ray, Hit& nearest) const {
  Meeting meeting;
  if (!scan::meet(ray, strips_[leaf], nearest.distance, meeting)) return false;
  nearest = {meeting.distance, Label::LEAF, tree_, branches_[leaf], meeting.cosine};
  return true;
}

}  // namespace vegetation_sim::scan
