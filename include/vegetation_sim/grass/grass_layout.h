// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "vegetation_sim/grass/blades/blade.h"
#include "vegetation_sim/grass/map/feature_map.h"
#include "vegetation_sim/grass/tread/tread_map.h"

namespace vegetation_sim::grass {

/// Describes a meadow completely: every blade follows from it.
struct Layout {
  std::shared_ptr<const FeatureMap> map{std::make_shared<const FeatureMap>()};
  std::uint64_t seed{0};          ///< key of the random numbers of the blades
  std::string terrain;            ///< file of the height map; empty: flat
  std::uint64_t terrain_hash{0};  ///< hash of the samples of the height map
  BladeModel blade_model{BladeModel::ARC};
  double tread_spacing{0.05};  ///< spacing of the fine nodes, as in TreadMap [m]
  TreadLaw tread;              ///< default law of a source

  std::uint64_t hash() const;
};

/// The `grass` section of a scenario.
struct Scene {
  Layout layout;
  TreadSettings treading;
};
/// Reads the section; relative file names count from `folder`. The caller sets the terrain and
/// tread_spacing, and calls finish().
Scene readScene(YamlSection& section, const std::string& folder, std::uint64_t seed,
                Faults& faults);

}  // namespace vegetation_sim::grass
