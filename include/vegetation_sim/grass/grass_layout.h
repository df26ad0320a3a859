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

/// A meadow as a law: who holds it knows where each blade stands.
struct Layout {
  std::shared_ptr<const FeatureMap> map{std::make_shared<const FeatureMap>()};
  std::uint64_t seed{0};          ///< keys the random numbers of the blades
  std::string terrain;            ///< file of the height map; empty: flat
  std::uint64_t terrain_hash{0};  ///< of its samples
  BladeModel blade_model{BladeModel::ARC};
  double tread_spacing{0.05};  ///< of the fine nodes, as TreadMap has it [m]
  TreadLaw tread;              ///< of a source that does not say its own

  std::uint64_t hash() const;
};

/// The `grass` section of a scenario.
struct Scene {
  Layout layout;
  TreadSettings treading;
};
/// Relative file names count from `folder`. Left to the caller: finish(), the terrain and
/// tread_spacing.
Scene readScene(YamlSection& section, const std::string& folder, std::uint64_t seed,
                Faults& faults);

}  // namespace vegetation_sim::grass
