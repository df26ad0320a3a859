// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "grass/lod/meadow_lod.h"
#include "grass/mesh/grass_geometry.h"
#include "nodes/markers/triangle_lists.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim {

/// Builds the marker lists of a meadow: ground (id 0), strips (id 1) and single blades near the
/// viewers (id 2). The farthest grass is left out if the budget does not suffice.
class GrassMarkers {
 public:
  /// @param points of the three lists together, at least 900.
  explicit GrassMarkers(int points);

  /// Chooses levels for the viewers and builds the array at `stamp`. Without viewers, it uses a
  /// place above the middle of the map.
  visualization_msgs::MarkerArray build(grass::MeadowLod& meadow, const grass::TreadMap& tread,
                                        const std::vector<Viewpoint>& viewers,
                                        const wind::Field& wind, grass::BladeModel model,
                                        const std::string& frame_id, Nanoseconds stamp);
  /// Points in use at the last build.
  std::size_t points() const { return lists_.used(); }
  std::size_t budget() const { return 3 * list_points_; }

 private:
  void addGround(const grass::MeadowLod& meadow);
  void addTile(const grass::MeadowLod& meadow, const grass::TileView& view, const grass::Tile& tile,
               const grass::TileMotion& motion, const Vec3& eye);
  void copy(const grass::GrassMesh& mesh, std::size_t list);

  enum List : std::size_t { GROUND, STRIPS, BLADES };
  std::size_t list_points_;  // of one list
  TriangleLists lists_;
  std::uint64_t ground_of_{0};  // hash of map and terrain
  double full_density_{1.0};    // [1/m^2]
  grass::GrassMesh strip_mesh_, blade_mesh_;
  std::vector<grass::BladeBlock> blocks_;
  grass::CrushPatch patch_;
};

}  // namespace vegetation_sim
