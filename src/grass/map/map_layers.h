// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/grass/map/feature_map.h"

namespace vegetation_sim::grass {

/// Name, unit and range of a layer of the map.
struct LayerRule {
  const char* name;
  const char* unit;
  Range range;
};
constexpr LayerRule HEIGHT_RULE{"height", "m", {0.0, 3.0}};
constexpr LayerRule DENSITY_RULE{"density", "1/m^2", {0.0, 20000.0}};
constexpr LayerRule COLOUR_RULE{"colour", "", {0.0, 1.0}};
constexpr LayerRule SHAPE_RULE{"shape", "", {0.0, 1.0}};
constexpr LayerRule MIX_RULE{"mix", "", {0.0, 1000.0}};

/// Returns the value of a layer at a node; row 0 is in the south.
double valueAt(const LayerInput& layer, int column, int row);
/// Returns the largest value of the layer.
double largestOf(const LayerInput& layer);
/// Adds the faults of one layer of a map of this size.
void checkLayer(const LayerInput& layer, const LayerRule& rule, const std::string& context,
                const MapLaw& law, Faults& faults);

/// Reads `name: {value: ...}` or `name: {image: ..., black: ..., white: ...}`; the path of an image
/// is relative to `folder`.
void readLayer(YamlSection& map, const LayerRule& rule, const std::string& folder,
               LayerInput& layer);

}  // namespace vegetation_sim::grass
