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

/// How everything in a layout moves.
struct Motion {
  PlaneSettings plane;
  FluidSettings fluid;  ///< its width is the plane's
  SourceSettings sources;
  OscillatorSettings oscillator;
  LayerSettings layers;
  CutSettings cuts;
  WarpSettings warp;
  int rate{30};  ///< ticks, and frames of the history [Hz]
};
/// A visit of every field, group after group; `begin` is called with each group's name first.
void describe(FieldVisitor& visitor, Motion& motion,
              const std::function<void(const char*)>& begin = {});
/// The fluid's settings with the width of the plane.
FluidSettings fluidOf(const Motion& motion);
/// Frames that hold the memory of the layers.
int historyFrames(const Motion& motion);

/// Trees of the forest whose crowns have leaves of a kind, on their own branches (S3-W2).
struct CrownRule {
  std::uint16_t kind{0};  ///< index into the layout's kinds; its leaves are those of a tree
  int first_tree{0}, trees{1};
};

void describe(FieldVisitor& visitor, CrownRule& crown);

/// Leafy vegetation as a law: who holds it can grow every leaf.
struct Layout {
  Motion motion;
  std::vector<PlantKind> kinds;
  std::vector<Plant> plants;  ///< ids 0, 1, 2 ...
  std::vector<CrownRule> crowns;
  std::uint64_t seed{0};  ///< of turbulence and of the layers' delays

  std::size_t leafCount() const;
  std::uint64_t hash() const;
};

/// Adds a fault for whatever is wrong: ranges, unknown kinds, too many leaves, a history beyond
/// its memory.
void check(const Layout& layout, Faults& faults);

/// Reads the `canopy` section of a scenario; plants stand on the terrain. Keys: docs/scenarios.md.
Layout readLayout(YamlSection section, const terrain::HeightMap& terrain, std::uint64_t seed,
                  Faults& faults);

/// Motion, kinds and crowns as text that parseLaw() reads, with 17 digits.
std::string writeLaw(const Layout& layout);
/// Layout without plants. @throws InvalidInput naming `name`, key, value and range.
Layout parseLaw(const std::string& text, const std::string& name);

}  // namespace vegetation_sim::canopy
