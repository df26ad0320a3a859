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

/// Walkers as one TRIANGLE_LIST of constant size, a person fifteen limbs: rviz updates such a list
/// in place; it is deleted when nobody is drawn. Each walker has the fewest facets that hold the
/// tolerance; where the points do not suffice, they go to the walkers whose error each point
/// lessens most (N7).
class CrowdMarkers {
 public:
  /// @param points of the list.
  explicit CrowdMarkers(int points);

  /// @param eyes who looks; none: all are seen alike. @param tolerance [pixel]
  visualization_msgs::MarkerArray build(const crowd::Crowd& crowd,
                                        const std::vector<Viewpoint>& eyes, double tolerance,
                                        const std::string& frame_id, Nanoseconds stamp);
  /// What was chosen at the last build [points], and the names of the tiers.
  const TierAllocation& balance() const { return balance_; }
  static std::vector<std::string> tiers();
  /// Points in use at the last build, of how many.
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
