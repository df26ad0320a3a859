// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <vector>

#include "vegetation_sim/crowd/crowd.h"
#include "vegetation_sim/crowd/skeleton.h"

namespace vegetation_sim {

/// Walkers as one TRIANGLE_LIST of constant size, a person fifteen limbs: rviz updates such a list
/// in place. The more people, the fewer facets a limb has; those who find no room are left out.
class CrowdMarkers {
 public:
  /// @param points of the list.
  explicit CrowdMarkers(int points);

  visualization_msgs::MarkerArray build(const crowd::Crowd& crowd, const std::string& frame_id,
                                        Nanoseconds stamp);
  /// Points in use at the last build, of how many.
  std::size_t points() const { return used_; }
  std::size_t budget() const { return list_.points.size(); }

 private:
  struct Ring;
  void addPerson(const crowd::Walker& walker, const terrain::HeightMap& terrain, int sides);
  void addLimb(const crowd::Limb& limb, std::size_t part, int sides,
               const std_msgs::ColorRGBA& colour, const std_msgs::ColorRGBA& end_colour);
  void addBand(const Ring& low, const Ring& high, int sides, const std_msgs::ColorRGBA& colour);
  void addPoint(const Vec3& point, const std_msgs::ColorRGBA& colour);

  std::size_t used_{0};
  visualization_msgs::Marker list_;
};

}  // namespace vegetation_sim
