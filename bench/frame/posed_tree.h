// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "forest/forest.h"
#include "tree/mesh/geometry_level.h"
#include "vegetation_sim/tree/motion/batch_poser.h"

namespace vegetation_sim::forest {

/// A tree as a display poses it.
struct PosedTree {
  Tree tree;
  BatchPoser poser;
  MeshDetail detail;
  BatchPoses poses;

  PosedTree(const Forest& forest, std::uint32_t id, const Viewpoint& viewer)
      : tree(growTree(forest.layout(), id, forest.terrain())),
        poser(tree),
        detail(meshDetail(geometryLevel(
            tree.skeleton.height * pixelsPerMetre(viewer, length(tree.foot - viewer.position)),
            -1))) {}

  /// Poses the tree at the forest's time, on the tier that was chosen for it.
  void pose(const Forest& forest, std::uint32_t id, const wind::Instant& wind, Nanoseconds now) {
    const ModalTreeState* modal = forest.view().modes.find(id);
    const auto weights = weightsAt(forest.view().levels.of(id), now, forest.layout().motion);
    const bool physical = !forest.promoted(id).branches.empty();
    if (!physical && modal && modalWeight(weights) >= 1.0)
      modal->pose(poser, now, poses);
    else if (physical || modal)
      narrowPoses(forest.poseInView(tree, id, now), poses);
    else
      poser.pose(wind.relativeTo(tree.foot), weights, detail.depths, poses);
  }
};

}  // namespace vegetation_sim::forest
