// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <cstddef>

#include "tree/shards/tree_owners.h"
#include "vegetation_sim/tree/growth/forest_layout.h"
#include "vegetation_sim/tree/growth/skeleton.h"

namespace vegetation_sim {

/// Returns an upright cylinder per tree, with the radius of the trunk at the ground and its height,
/// after a marker that deletes those before (N14). A trunk that has broken or been cut ends at its
/// lowest break. The id of a marker is that of its tree.
/// @param most number of trees, those with the lowest ids. @param frame_id world frame.
/// @param broken what has come off the trees. @param owners whose trees are drawn; of a part of all
/// shards there is no deleting marker, which would delete the trunks of the others.
visualization_msgs::MarkerArray trunkMarkersOf(const forest::Layout& layout,
                                               const terrain::HeightMap& terrain,
                                               const std::string& frame_id, std::size_t most,
                                               const forest::BrokenTrees& broken,
                                               const forest::TreeOwners& owners = {});

}  // namespace vegetation_sim
