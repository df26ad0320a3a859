// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "grass/lod/meadow_lod.h"
#include "grass/lod/node_wind.h"
#include "grass/mesh/grass_geometry.h"
#include "grass/tread_simulation.h"
#include "scenes/hashing.h"
#include "scenes/scenario.h"

namespace vegetation_sim::scenes {

/// The grass of a scene: the trodden ground, and a display that follows it by its updates and draws
/// what one eye sees.
class GrassPart {
 public:
  explicit GrassPart(const Scenario& scenario);

  void setWind(const wind::Field& wind) { wind_ = wind; }
  void setEye(const Viewpoint& eye) { eye_ = eye; }
  void advance(Nanoseconds stamp, bool key_frame);
  void addTo(Hashes& hashes);

  /// Moves a source along the ground to a place [m].
  void tread(const std::string& source, double x, double y, Nanoseconds stamp);
  /// Treads a straight line at once.
  void stroke(const std::string& source, const Vec3& from, const Vec3& to, Nanoseconds stamp);
  void lift(const std::string& source, Nanoseconds stamp);
  void raise(double x, double y, double radius) { field_.raise({x, y}, radius); }
  /// Area that is tilted by more than half a radian [m^2].
  double crushedArea() const;

  grass::TreadSimulation& field() { return field_; }
  const grass::Layout& layout() const { return field_.layout(); }
  const grass::TreadMap& shownTread() const { return shown_tread_; }
  const wind::Field& wind() const { return wind_; }

 private:
  grass::TreadInput inputOf(const std::string& source, grass::TreadAction action) const;
  void draw(const grass::TileView& view, const grass::NodeWind& air, Hashes& hashes);

  grass::TreadMap tread_;
  grass::TreadSimulation field_;
  grass::MeadowLod meadow_;      ///< of the display
  grass::TreadMap shown_tread_;  ///< of the display
  grass::TreadReplica replica_;
  wind::Field wind_;
  Viewpoint eye_;
  Nanoseconds stamp_{START};
  std::vector<grass::BladeBlock> blocks_;
  grass::GrassMesh mesh_;
};

}  // namespace vegetation_sim::scenes
