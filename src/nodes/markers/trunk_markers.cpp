// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/markers/trunk_markers.h"

#include <algorithm>

namespace vegetation_sim {
namespace {

// Returns the height of what is left of a trunk [m].
double trunkHeight(const forest::TreeSeed& seed, const forest::Species& species,
                   const forest::BrokenBranches& broken) {
  double height = species.height * trunkScale(seed, species);
  if (broken.empty()) return height;
  const forest::Skeleton tree = grow(seed, species);
  for (const forest::BrokenBranch& piece : broken)
    if (const forest::Branch& branch = tree.branches.at(static_cast<std::size_t>(piece.branch));
        branch.depth == 0)
      height = std::min(height, branch.rest.position.z());
  return height;
}

}  // namespace

visualization_msgs::MarkerArray trunkMarkersOf(const forest::Layout& layout,
                                               const terrain::HeightMap& terrain,
                                               const std::string& frame_id, std::size_t most,
                                               const forest::BrokenTrees& broken,
                                               const forest::TreeOwners& owners) {
  visualization_msgs::MarkerArray out;
  visualization_msgs::Marker marker;
  marker.header.frame_id = frame_id;
  marker.ns = "trunks";
  marker.action = visualization_msgs::Marker::DELETEALL;
  marker.pose.orientation.w = 1.0;
  if (owners.shard().count == 1) out.markers.push_back(marker);  // else those of other shards too
  marker.action = visualization_msgs::Marker::ADD;
  marker.type = visualization_msgs::Marker::CYLINDER;
  marker.color.r = 0.36F;
  marker.color.g = 0.27F;
  marker.color.b = 0.19F;
  marker.color.a = 1.0F;
  std::size_t left = most;
  for (std::uint32_t id = 0; id < layout.treeCount() && left > 0; ++id) {
    if (!owners.owns(id)) continue;
    --left;
    const forest::TreeSeed seed = seedOf(layout, id);
    const forest::Species& species = layout.species[seed.species];
    const double scale = trunkScale(seed, species);
    const Vec3 foot = forest::footOf(seed, terrain);
    marker.id = static_cast<std::int32_t>(id);
    marker.scale.x = marker.scale.y = 2.0 * species.trunk_radius * scale;
    marker.scale.z = trunkHeight(seed, species, forest::brokenOf(broken, id));
    marker.pose.position.x = foot.x();
    marker.pose.position.y = foot.y();
    marker.pose.position.z = foot.z() + 0.5 * marker.scale.z;
    out.markers.push_back(marker);
  }
  return out;
}

}  // namespace vegetation_sim
