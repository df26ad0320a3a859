// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "reference/sensors/binary_scene.h"

#include "reference/sensors/cast_plain.h"

namespace vegetation_sim::scan {
namespace {

std::vector<Box> boxesOf(const PosedTree& tree) {
  std::vector<Box> out;
  for (std::size_t i = 0; i < tree.parts(); ++i) {
    const Rod& rod = tree.branches()[i].rod;
    out.push_back(boxOf(rod));
    out.back().add(rod.base, tree.branches()[i].leaf_radius);
    out.back().add(rod.base + rod.length * rod.axis, tree.branches()[i].leaf_radius);
  }
  return out;
}

}  // namespace

BinaryScene::BinaryScene(const Scene& scene) : scene_(scene) {
  std::vector<Box> trees, limbs;
  for (const auto& tree : scene.trees.all()) {
    branches_.emplace_back();
    branches_.back().build(boxesOf(*tree));
    trees.push_back(branches_.back().bounds());
  }
  trees_.build(trees);
  for (const Rod& rod : scene.people.rods()) limbs.push_back(boxOf(rod));
  limbs_.build(limbs);
}

void BinaryScene::meetTrees(const Ray& ray, Hit& nearest) const {
  trees_.visit(ray, nearest, [&](std::size_t tree) {
    branches_[tree].visit(ray, nearest, [&](std::size_t branch) {
      meetBranchPlainly(*scene_.trees.all()[tree], branch, ray, nearest);
    });
  });
}

Hit BinaryScene::cast(const Ray& ray, double reach) const {
  Hit out = castToGround(scene_, ray, reach);
  meetTrees(ray, out);
  meetEachPlant(scene_.plants, ray, out);
  limbs_.visit(ray, out, [&](std::size_t limb) { scene_.people.meetLimb(limb, ray, out); });
  scene_.grass.meet(ray, out, GrassVolume::Cells::ALL);
  return out;
}

}  // namespace vegetation_sim::scan
