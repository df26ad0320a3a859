// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim::grass {

/// Properties that all blades of a kind of grass or flower share (S2-W2). The FeatureMap has those
/// that vary with the place: height, density, colour, shape.
struct Species {
  std::string name{"grass"};
  double height{1.0};                 ///< factor on the map's height
  double height_spread{0.4};          ///< a blade is shorter by up to this share
  double width{0.005};                ///< width of a blade at its root [m]
  double lean{0.5};                   ///< largest bend at rest, at shape 1 [rad]
  double compliance{0.07};            ///< bend per wind speed [rad s/m]
  Vec3 colour{0.31, 0.43, 0.14};      ///< red, green, blue at the map's colour 0, each 0 to 1
  Vec3 dry_colour{0.66, 0.58, 0.31};  ///< the same at the map's colour 1
  double flower_radius{0.0};          ///< radius of the flower at the tip, 0: none [m]
  Vec3 flower_colour{0.90, 0.85, 0.30};
};

void describe(FieldVisitor& visitor, Species& species);

/// Returns the species at a stage of growth from 0 (seedling) to 1 (as it is): height and width
/// times the factors of growthFactors(), within the ranges. Flowers and ears come at 0.6.
Species applyStage(const Species& species, double stage);

constexpr int MAX_SPECIES = 8;  ///< largest number of species of a map

}  // namespace vegetation_sim::grass
