// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "reference/sensors/cast_plain.h"

#include <algorithm>

#include "reference/sensors/capsule.h"
#include "sensors/media/beer_lambert.h"

namespace vegetation_sim::scan {

void meetBranchPlainly(const PosedTree& tree, std::size_t i, const Ray& ray, Hit& nearest) {
  const PosedBranch& branch = tree.branches()[i];
  const int index = tree.branchOf(i);
  Meeting meeting;
  if (meet(ray, branch.rod, nearest.distance, meeting))
    nearest = {meeting.distance, branch.trunk ? Label::TRUNK : Label::BRANCH, tree.id(), index,
               meeting.cosine};
  if (!(branch.leaf_radius > 0.0)) return;
  const Stretch part = withinPlainly(ray, branch.rod, branch.leaf_radius);
  if (!(part.from < part.to && part.from < nearest.distance)) return;
  const Vec3 place = rotate(conjugate(branch.turn), Vec3(ray.at(part.from) - branch.rod.base));
  const double way =
      depthAt(shareOf(cellAt(place, LEAF_CELL), branch.leaf_key)) / branch.extinction;
  if (part.from + way < std::min(part.to, nearest.distance))
    nearest = {part.from + way, Label::LEAF, tree.id(), index, LEAF_COSINE};
}

void meetEachBranch(const Trees& trees, const Ray& ray, Hit& nearest) {
  for (const auto& tree : trees.all())
    for (std::size_t i = 0; i < tree->parts(); ++i) meetBranchPlainly(*tree, i, ray, nearest);
}

void meetEachPlant(const Plants& plants, const Ray& ray, Hit& nearest) {
  for (const auto& plant : plants.all()) {
    for (std::size_t i = 0; i < plant->strips().size(); ++i) plant->meetStrip(i, ray, nearest);
    for (std::size_t i = 0; i < plant->stems().size(); ++i) plant->meetStem(i, ray, nearest);
  }
}

Hit castPlain(const Scene& scene, const Ray& ray, double reach) {
  Hit out = castToGround(scene, ray, reach);
  meetEachBranch(scene.trees, ray, out);
  meetEachPlant(scene.plants, ray, out);
  for (const auto& crown : scene.crowns.all())
    for (std::size_t leaf = 0; leaf < crown->parts(); ++leaf) crown->meetLeaf(leaf, ray, out);
  for (std::size_t i = 0; i < scene.people.limbs(); ++i) scene.people.meetLimb(i, ray, out);
  scene.grass.meet(ray, out, GrassVolume::Cells::ALL);
  return out;
}

}  // namespace vegetation_sim::scan
