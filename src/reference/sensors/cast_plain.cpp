// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "reference/sensors/cast_plain.h"

namespace vegetation_sim::scan {

void meetEachBranch(const Trees& trees, const Ray& ray, Hit& nearest) {
  for (const auto& tree : trees.all())
    for (std::size_t i = 0; i < tree->branches(); ++i) tree->meetBranch(i, ray, nearest);
}

Hit castPlain(const Scene& scene, const Ray& ray, double reach) {
  Hit out = castToGround(scene, ray, reach);
  meetEachBranch(scene.trees, ray, out);
  for (std::size_t i = 0; i < scene.people.limbs(); ++i) scene.people.meetLimb(i, ray, out);
  scene.grass.meet(ray, out);
  return out;
}

}  // namespace vegetation_sim::scan
