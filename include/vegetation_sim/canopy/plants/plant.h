// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "vegetation_sim/canopy/plants/leaf.h"
#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::canopy {

/// Limit for all plants together. Those of a kind that is read from a file share their leaves,
/// which count once.
constexpr std::size_t MOST_LEAVES = 3000000;
constexpr std::size_t MOST_SHOWN_LEAVES = 100000000;  ///< limit without sharing
constexpr std::size_t MOST_PLANTS = 65536;

/// SHRUB: leaves on tufts from the ground up. CROWN: tufts on a bare trunk. REED: upright ribbons.
/// KELP: wavy ribbons. Ribbons are chains of pieces. MESH and SLICES are read from a file. STALK: a
/// stalk with arching ribbons on two sides, as maize. TRELLIS: two posts with wires between them.
enum class PlantShape : int {
  SHRUB = 0,
  CROWN = 1,
  REED = 2,
  KELP = 3,
  MESH = 4,
  SLICES = 5,
  STALK = 6,
  TRELLIS = 7
};

constexpr const char* RIGID_WORDS = "wood trunk bark branch stem twig bough";
constexpr std::size_t LONGEST_RIGID_WORDS = 500;  ///< [characters]

/// A cell of slices is drawn as leaves on a twig, or as a puff of a cloud or of smoke (S3-W6).
enum class CellLook { LEAVES, PUFFS };

/// Axis of a mesh that points up.
enum class UpAxis { Z, Y };

/// Share of a crown's height that is trunk.
constexpr double TRUNK_SHARE = 0.35;

/// Least stiffness of plants that answer bodies [N/m^3]: a smaller one gives no finite step.
constexpr double LEAST_PUSH_STIFFNESS = 1e-3;

/// How a kind answers bodies. Forces are those per area of ground or per volume of overlap, so that
/// neither cells nor leaves matter.
struct PushLaw {
  double stiffness{50.0};   ///< force on the tops over their displacement and ground area [N/m^3]
  double frequency{1.5};    ///< of the free swing back [Hz]
  double damping{0.4};      ///< share of the critical damping
  double set{0.0};          ///< share of the largest lean that remains
  double recovery{60.0};    ///< time constant in which it disappears [s]
  double pressure{5000.0};  ///< pressure per depth of the overlap [N/m^3]
  double drag{1000.0};      ///< force per volume of the overlap and relative speed [N s/m^4]
  double cell{0.25};        ///< wanted edge of cells that lean alike [m]
};
void describe(FieldVisitor& visitor, PushLaw& law);

/// Properties of one kind of plant (S3-30).
struct PlantKind {
  std::string name{"shrub"};
  PlantShape shape{PlantShape::SHRUB};
  double height{1.6};        ///< [m]
  double radius{1.0};        ///< [m], of a TRELLIS the distance of its posts
  int leaves{1500};          ///< number of leaves or ribbons
  int pieces{6};             ///< pieces of a ribbon
  double leaf_length{0.12};  ///< length of a leaf [m]
  double leaf_width{0.05};   ///< width of a leaf or a ribbon [m]
  /// Number of rigid stems, which are never displaced (S3-02); of a STALK the branches of its
  /// tassel, of a TRELLIS its wires.
  int stems{9};
  double stem_radius{0.012};                  ///< [m]
  Vec3 colour{Vec3(0.16, 0.34, 0.09)};        ///< red, green, blue
  Vec3 colour_young{Vec3(0.42, 0.55, 0.18)};  ///< colour of the lightest leaves
  Vec3 stem_colour{Vec3(0.30, 0.23, 0.15)};
  UpAxis up{UpAxis::Z};             ///< vertical axis of a mesh
  double slope{0.0};                ///< rise of the wires of a TRELLIS per metre
  double solid{0.5};                ///< smallest density of a slice's cell that gets a leaf
  CellLook look{CellLook::LEAVES};  ///< of SLICES
  std::string file;                 ///< file of a mesh, or of the first slice; scaled to `height`
  /// Words, separated by blanks: faces of a mesh whose material, object or node has one of them in
  /// its name, in letters of any case, are rigid (S3-02).
  std::string rigid{RIGID_WORDS};
  std::shared_ptr<const Form> form;  ///< contents of the file, shared by plants and threads
  PushLaw push;                      ///< described on its own
};
/// Returns whether plants of this kind are read from files.
inline bool isRead(const PlantKind& kind) {
  return kind.shape == PlantShape::MESH || kind.shape == PlantShape::SLICES;
}
/// Returns whether the leaves of plants of this kind are ribbons.
inline bool isRibbon(const PlantKind& kind) {
  return kind.shape == PlantShape::REED || kind.shape == PlantShape::KELP ||
         kind.shape == PlantShape::STALK;
}
/// Visits the fields; `slope` only of a TRELLIS and `look` only of SLICES.
void describe(FieldVisitor& visitor, PlantKind& kind);

/// Returns the kind at a stage of growth from 0 (seedling) to 1 (as it is): sizes and leaves times
/// the factors of growthFactors(), clamped to the ranges. A STALK has a tassel from 0.8 on; a
/// TRELLIS does not grow.
PlantKind applyStage(const PlantKind& kind, double stage);

/// One plant of a layout.
struct Plant {
  std::uint64_t seed{0};        ///< key of the random numbers of the plant
  std::uint16_t kind{0};        ///< index into the layout's kinds
  Vec3 position{Vec3::Zero()};  ///< foot, world [m]
  double yaw{0.0};              ///< [rad]
  double scale{1.0};            ///< scale relative to its kind
};

/// Height of a plant that has not been cut [m].
constexpr double UNCUT = 1e9;
/// Heights above their feet at which plants have been cut, by id [m].
using Stubble = std::map<std::uint32_t, double>;
/// Heights at which plants can be cut [m].
constexpr Range CUT_HEIGHTS{0.0, 5.0};

/// Grows a plant: a pure function of kind, plant and the height at which it has been cut [m].
GrownPlant grow(const PlantKind& kind, const Plant& plant, double height = UNCUT);

/// Returns the number of strips that grow() makes of a plant of this kind; 0 if its file has not
/// been read.
std::size_t leafCount(const PlantKind& kind);

}  // namespace vegetation_sim::canopy
