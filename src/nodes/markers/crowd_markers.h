// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/lod/tier_hysteresis.h"
#include "crowd/agents/crowd.h"
#include "nodes/markers/triangle_lists.h"
#include "vegetation_sim/core/lod/viewpoint.h"

namespace vegetation_sim {

/// Builds the marker list of a crowd, with fifteen limbs for each walker. Each has the fewest
/// facets that hold the tolerance. If the budget does not suffice, points go to the walkers whose
/// error each point reduces most.
class CrowdMarkers {
 public:
  /// @param points of the list.
  explicit CrowdMarkers(int points);

  /// @param eyes of the viewers; if there are none, all walkers have the same size in the picture.
  /// @param tolerance [pixel]
  visualization_msgs::MarkerArray build(const crowd::Crowd& crowd,
                                        const std::vector<Viewpoint>& eyes, double tolerance,
                                        const std::string& frame_id, Nanoseconds stamp);
  /// The tiers chosen at the last build, with costs in points, and their names.
  const TierAllocation& balance() const { return balance_; }
  static std::vector<std::string> tiers();
  /// Points in use at the last build, and the largest number.
  std::size_t points() const { return lists_.used(); }
  std::size_t budget() const { return lists_.size(0); }

 private:
  void choose(const crowd::Crowd& crowd, const std::vector<Viewpoint>& eyes, double tolerance,
              Nanoseconds stamp);
  void addPerson(const crowd::Walker& walker, const terrain::HeightMap& terrain, int sides);

  std::vector<TierChoice> choices_;  // as the crowd has its walkers
  TierHysteresis held_;
  TierAllocation balance_;
  TriangleLists lists_;
};

}  // namespace vegetation_sim
