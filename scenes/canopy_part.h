// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "scenes/hashing.h"
#include "scenes/scenario.h"
#include "vegetation_sim/canopy/canopy.h"

namespace vegetation_sim::scenes {

/// The leafy plants of a scene, and a replica that follows them by their updates.
class CanopyPart {
 public:
  explicit CanopyPart(const Scenario& scenario);

  void setWind(const wind::Field& wind) { canopy_.setWind(wind); }
  void setView(const std::optional<canopy::CutView>& view) { canopy_.setViewer(view); }
  void advance(Nanoseconds stamp);
  void addTo(Hashes& hashes);

  canopy::Canopy& canopy() { return canopy_; }
  /// Mean distance of the tips of all leaves from where they are at rest [m].
  double meanDisplacement();

 private:
  canopy::Canopy canopy_;
  canopy::Replica replica_;
  std::vector<std::vector<canopy::Leaf>> leaves_;  ///< of each plant
};

}  // namespace vegetation_sim::scenes
