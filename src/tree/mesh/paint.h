// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "tree/mesh/bark_mesh.h"
#include "vegetation_sim/tree/growth/species.h"

namespace vegetation_sim::forest {

/// sRGB, 0 to 1.
using Colour = std::array<float, 3>;

Colour mixColours(const Colour& a, const Colour& b, double weight_of_b);

/// Unlit colours of one tree: those of its species with a variation per tree.
class TreePaint {
 public:
  TreePaint(const Species& species, std::uint64_t tree_seed);

  /// @param radius of the wood [m]; thick wood has the colour of bark, twigs their own.
  Colour bark(double radius) const;
  Colour leaf(const LeafCard& card) const;

 private:
  Colour bark_, twig_, leaf_old_, leaf_young_;
  double thin_, thick_;  // radii [m]
};

}  // namespace vegetation_sim::forest
