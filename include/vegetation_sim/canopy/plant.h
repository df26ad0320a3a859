// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vegetation_sim/common/fields.h"
#include "vegetation_sim/common/vectors.h"

namespace vegetation_sim::canopy {

constexpr std::size_t MOST_LEAVES = 2000000;  ///< of all plants together
constexpr std::size_t MOST_PLANTS = 65536;

/// shrub: leaves on a ball from the ground up; crown: a ball on a bare trunk; reed: upright
/// ribbons; kelp: wavy ribbons. Ribbons are chains of pieces.
enum class Shape : int { SHRUB = 0, CROWN = 1, REED = 2, KELP = 3 };

/// What plants of one kind have in common (S3-30).
struct PlantKind {
  std::string name{"shrub"};
  int shape{0};                               ///< Shape
  double height{1.6};                         ///< [m]
  double radius{1.0};                         ///< [m]
  int leaves{1500};                           ///< leaves, or ribbons
  int pieces{6};                              ///< of a ribbon
  double leaf_length{0.12};                   ///< of a leaf [m]
  double leaf_width{0.05};                    ///< of a leaf or a ribbon [m]
  int stems{9};                               ///< rigid, never displaced (S3-02)
  double stem_radius{0.012};                  ///< [m]
  Vec3 colour{Vec3(0.16, 0.34, 0.09)};        ///< red, green, blue
  Vec3 colour_young{Vec3(0.42, 0.55, 0.18)};  ///< of the lightest leaves
  Vec3 stem_colour{Vec3(0.30, 0.23, 0.15)};
};
void describe(FieldVisitor& visitor, PlantKind& kind);

/// All that is permanent of one plant.
struct Plant {
  std::uint64_t seed{0};        ///< keys every random number of the plant
  std::uint16_t kind{0};        ///< index into the layout's kinds
  Vec3 position{Vec3::Zero()};  ///< foot [m], world
  double yaw{0.0};              ///< [rad]
  double scale{1.0};            ///< over the size of its kind
};

/// A leaf, or a piece of a ribbon, at rest in the world: a four-cornered strip from root to tip.
struct Leaf {
  Vec3 anchor{
      Vec3::Zero()};  ///< root of what hangs together; it alone chooses the layer (S3-03) [m]
  Vec3 root{Vec3::Zero()}, tip{Vec3::Zero()};  ///< [m]
  Vec3 side{Vec3::Zero()};                     ///< half the width across [m]
  float root_width{0.6F};                      ///< of the strip's ends, over `side`
  float tip_width{0.6F};
  float shade{0.0F};  ///< from colour to colour_young
};

/// A straight rigid part.
struct Stem {
  Vec3 from, to;  ///< [m]
  double radius;  ///< [m]
};

/// A grown plant, in the world: a pure function of kind and plant.
struct GrownPlant {
  std::vector<Leaf> leaves;
  std::vector<Stem> stems;
};
GrownPlant grow(const PlantKind& kind, const Plant& plant);

/// Strips that grow() makes of a plant of this kind.
std::size_t leafCount(const PlantKind& kind);

}  // namespace vegetation_sim::canopy
