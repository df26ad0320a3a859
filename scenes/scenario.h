// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "crowd/agents/crowd_scene.h"
#include "forest/forest.h"
#include "grass/lod/meadow_lod.h"
#include "sensors/sweep.h"
#include "vegetation_sim/canopy/canopy_layout.h"
#include "vegetation_sim/grass/grass_layout.h"
#include "vegetation_sim/terrain/height_map.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::scenes {

/// Time of tick 0 of every scene.
constexpr Nanoseconds START = 1700000000LL * NANOSECONDS_PER_SECOND;

/// Everything that the YAML file of a scene describes. The sections have the keys of the shipped
/// scenarios; `levels` and `grass_levels` hold the settings of the levels of detail, `scan` the
/// beams of a lidar, `later_wind` the wind after an edit.
struct Scenario {
  int rate{60};  ///< ticks per second
  std::shared_ptr<const terrain::HeightMap> terrain;
  wind::Field wind, later_wind;
  std::optional<forest::Layout> forest;
  forest::Settings levels;
  forest::PhysicsSettings physics;
  std::optional<grass::Scene> grass;
  grass::MeadowSettings grass_levels;
  std::optional<canopy::Layout> canopy;
  std::uint64_t seed{0};
  std::optional<crowd::Scene> crowd;
  std::optional<scan::Lidar> scan;
};

/// Reads scenes/NAME.yaml. @throws InvalidInput with all faults.
Scenario loadScenario(const std::string& name);

}  // namespace vegetation_sim::scenes
