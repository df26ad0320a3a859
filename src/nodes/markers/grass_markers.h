// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "grass/lod/meadow_lod.h"
#include "grass/mesh/grass_geometry.h"
#include "grass/tread_simulation.h"
#include "nodes/markers/marker_publisher.h"
#include "ros/services/allocation_report.h"
#include "vegetation_sim/grass/lod/colour_mask.h"
#include "vegetation_sim/terrain/height_map.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim {

/// Builds the marker lists of a meadow: ground (id 0), strips (id 1) and single blades near the
/// viewers (id 2). The farthest grass is left out if the budget does not suffice.
class GrassMarkers : public MarkerBuilder {
 public:
  /// @param points of the three lists together, at least 900.
  GrassMarkers(const grass::TreadSimulation& field,
               std::shared_ptr<const terrain::HeightMap> terrain, const wind::Field& wind,
               const grass::ColourMasks& colours, const grass::MeadowSettings& settings,
               int points);

  /// Without viewers, it uses a place above the middle of the map.
  void build(const std::vector<Viewpoint>& viewers, Nanoseconds stamp) override;
  void setSettings(const grass::MeadowSettings& settings);
  void reportTiers(diagnostic_updater::DiagnosticStatusWrapper& status) const {
    report(balance(), balanceTerms(), status);
  }
  /// Names and limits of the last choice, balance().
  BalanceTerms balanceTerms() const;
  const TierAllocation& balance() const { return meadow_.balance(); }

 private:
  void addGround();
  void addTile(const grass::TileView& view, const grass::Tile& tile,
               const grass::TileMotion& motion, const Vec3& eye);
  void copy(const grass::GrassMesh& mesh, std::size_t list);

  enum List : std::size_t { GROUND, STRIPS, BLADES };
  const grass::TreadSimulation& field_;
  const wind::Field& wind_;
  const grass::ColourMasks& colours_;
  grass::MeadowSettings settings_;
  grass::MeadowLod meadow_;
  std::size_t list_points_;     // of one list
  std::uint64_t ground_of_{0};  // hash of map and terrain
  double full_density_{1.0};    // [1/m^2]
  grass::GrassMesh strip_mesh_, blade_mesh_;
  std::vector<grass::BladeBlock> blocks_;
  grass::CrushPatch patch_;
};

}  // namespace vegetation_sim
