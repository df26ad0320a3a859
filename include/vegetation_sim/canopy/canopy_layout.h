// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "vegetation_sim/canopy/flow/fluid.h"
#include "vegetation_sim/canopy/flow/oscillator.h"
#include "vegetation_sim/canopy/layers/layer_cut.h"
#include "vegetation_sim/canopy/layers/plane_view.h"
#include "vegetation_sim/canopy/layers/warp.h"
#include "vegetation_sim/canopy/plants/plant.h"
#include "vegetation_sim/core/config/yaml.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim::canopy {

/// Allowed coordinates of a plant [m].
constexpr Range PLANT_COORDINATES{-1e6, 1e6};

/// Settings of the motion of all vegetation of a layout.
struct Motion {
  PlaneSettings plane;
  FluidSettings fluid;  ///< settings whose width is that of the plane
  SourceSettings sources;
  OscillatorSettings oscillator;
  LayerSettings layers;
  CutSettings cuts;
  WarpSettings warp;
  int rate{30};  ///< rate of ticks and of frames of the history [Hz]
};
/// Visits every field, group after group; calls `begin` with each group's name first.
void describe(FieldVisitor& visitor, Motion& motion,
              const std::function<void(const char*)>& begin = {});
/// Returns the fluid's settings with the width of the plane.
FluidSettings fluidOf(const Motion& motion);
/// Returns the number of frames that the history of the layers has.
int historyFrames(const Motion& motion);

/// Gives the trees of the forest leaves of a kind on their own branches (S3-W2).
struct CrownRule {
  std::uint16_t kind{0};  ///< index into the layout's kinds; a kind's leaves are those of one tree
  int first_tree{0}, trees{1};
};

void describe(FieldVisitor& visitor, CrownRule& crown);

/// Describes leafy vegetation completely: every leaf follows from it.
struct Layout {
  Motion motion;
  std::vector<PlantKind> kinds;
  std::vector<Plant> plants;  ///< The id of a plant is its index.
  std::vector<CrownRule> crowns;
  std::uint64_t seed{0};  ///< seed of turbulence and of the layers' delays

  std::size_t leafCount() const;
  /// Returns the number of leaves that differ: plants of a kind that is read from a file share
  /// theirs.
  std::size_t ownLeafCount() const;
  std::uint64_t hash() const;
};

/// Adds the faults of a layout: ranges, unknown kinds, too many leaves, a history beyond its
/// memory.
void check(const Layout& layout, Faults& faults);

/// Reads the `canopy` section of a scenario and places the plants on the terrain. Keys:
/// docs/scenarios.md.
Layout readLayout(YamlSection section, const terrain::HeightMap& terrain, std::uint64_t seed,
                  Faults& faults);

/// Writes motion, kinds and crowns as text for parseLaw(), with 17 digits.
std::string writeLaw(const Layout& layout);
/// Returns the layout without plants. @throws InvalidInput with `name`, key, value and range.
Layout parseLaw(const std::string& text, const std::string& name);

}  // namespace vegetation_sim::canopy
