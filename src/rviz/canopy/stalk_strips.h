// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "vegetation_sim/canopy/plants/plant.h"

namespace vegetation_sim::view {

/// Turn of the side of a strip about its midrib.
struct Roll {
  float cos{1.f}, sin{0.f};
};

/// How the ends of a strip are drawn: its root, then its tip.
struct StripPaint {
  std::array<Vec3, 4> normals{};  ///< left and right at the root, then at the tip; unit
  std::array<Vec3, 2> colours{};
  std::array<double, 2> light{};            ///< share of the daylight
  std::array<float, 2> across{{0.f, 1.f}};  ///< part of the picture of a ribbon
};

/// A strip of a stalk as it is drawn.
struct StalkStrip {
  canopy::Leaf leaf;
  StripPaint paint;
  std::array<Roll, 2> roll{};  ///< at its root and its tip
  int face{-1};                ///< of a piece of the stalk, 0 to 2; -1: a leaf or a tassel
};

/// Returns the strips that show a STALK: a round stalk up to its top or cut, which moves as a whole
/// with its leaves, and the leaves, which narrow to it, are channels and turn about their midribs.
/// Light falls off towards the ground.
/// @param grown what grow() made of the plant that was cut at `height`, or UNCUT [m].
std::vector<StalkStrip> stalkStrips(const canopy::PlantKind& kind, const canopy::Plant& plant,
                                    double height, const canopy::GrownPlant& grown);

}  // namespace vegetation_sim::view
