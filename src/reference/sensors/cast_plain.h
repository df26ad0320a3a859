// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sensors/sensor_scene.h"

namespace vegetation_sim::scan {

/// Returns the same as cast(), but tests every branch, leaf of a plant and limb.
Hit castPlain(const Scene& scene, const Ray& ray, double reach);
/// Does the same as PosedTree::meetBranch(), in full for each ray.
void meetBranchPlainly(const PosedTree& tree, std::size_t branch, const Ray& ray, Hit& nearest);
/// Does the same as Trees::meet(), but tests every branch.
void meetEachBranch(const Trees& trees, const Ray& ray, Hit& nearest);
/// Does the same as Plants::meet(), but tests every leaf and stem.
void meetEachPlant(const Plants& plants, const Ray& ray, Hit& nearest);

}  // namespace vegetation_sim::scan
