// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "vegetation_sim/canopy/plants/leaf.h"
#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::canopy {

constexpr std::size_t MOST_LEAVES = 3000000;  ///< of all plants together
constexpr std::size_t MOST_PLANTS = 65536;

/// shrub: leaves on tufts from the ground up; crown: tufts on a bare trunk; reed: upright ribbons;
/// kelp: wavy ribbons. Ribbons are chains of pieces. mesh, slices: read from a file.
enum class PlantShape : int { SHRUB = 0, CROWN = 1, REED = 2, KELP = 3, MESH = 4, SLICES = 5 };

/// Axis of a mesh that points up.
enum class UpAxis { Z, Y };

/// What plants of one kind have in common (S3-30).
struct PlantKind {
  std::string name{"shrub"};
  PlantShape shape{PlantShape::SHRUB};
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
  UpAxis up{UpAxis::Z};              ///< of a mesh
  double solid{0.5};                 ///< density from which a cell of a slice has a leaf
  std::string file;                  ///< of a mesh, or of the first slice; scaled to `height`
  std::shared_ptr<const Form> form;  ///< what was read from it; many plants and threads share it
};
/// Whether plants of this kind are read rather than grown.
inline bool isRead(const PlantKind& kind) {
  return kind.shape == PlantShape::MESH || kind.shape == PlantShape::SLICES;
}
void describe(FieldVisitor& visitor, PlantKind& kind);

/// All that is permanent of one plant.
struct Plant {
  std::uint64_t seed{0};        ///< keys every random number of the plant
  std::uint16_t kind{0};        ///< index into the layout's kinds
  Vec3 position{Vec3::Zero()};  ///< foot [m], world
  double yaw{0.0};              ///< [rad]
  double scale{1.0};            ///< over the size of its kind
};

/// A pure function of kind and plant.
GrownPlant grow(const PlantKind& kind, const Plant& plant);

/// Strips that grow() makes of a plant of this kind; none of what has not been read.
std::size_t leafCount(const PlantKind& kind);

}  // namespace vegetation_sim::canopy
