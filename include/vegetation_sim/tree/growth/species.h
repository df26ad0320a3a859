// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "vegetation_sim/core/config/yaml.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/tree/growth/limb_rule.h"

namespace vegetation_sim::forest {

/// Maximum number of recursion depths of a tree: trunk, limbs, ... twigs.
constexpr int MAX_DEPTHS = 6;
/// Maximum number of joints of a tree; growth stops there.
constexpr int MAX_BRANCHES = 16384;

/// Density of air [kg/m^3].
constexpr double AIR_DENSITY = 1.225;

enum class LeafShape : int { BROAD = 0, NEEDLE = 1, SMALL = 2, LONG = 3 };

/// Properties of all trees of a species: growth rules, wood, leaves. One file in config/species
/// each.
struct Species {
  std::string name;
  double height{8.0};             ///< of the trunk [m]
  double height_variation{0.15};  ///< +- fraction
  double trunk_radius{0.15};      ///< at the ground, for `height` [m]
  double twig_radius{0.004};      ///< minimum radius of wood [m]
  double slenderness{90.0};       ///< maximum length of a limb in its base radii
  double lean{0.03};              ///< largest lean of the trunk [rad]
  double angle_thin{1.4};  ///< largest angle to the parent for a limb of relative diameter 0 [rad]
  double angle_thick{0.35};      ///< the same for relative diameter 1 (S1-11) [rad]
  double noise{1.0};             ///< amplitude of all growth noise; 0: the bare rules (S1-12)
  double youngs_modulus{8e9};    ///< [Pa]
  double density{900.0};         ///< [kg/m^3]
  double damping_ratio{0.1};     ///< of each joint, for the inertia of its sub-tree
  double drag_coefficient{0.3};  ///< of branches and leaves, sheltering included
  double reference_speed{8.0};   ///< wind speed at which linear and quadratic drag are equal [m/s]
  double leaf_size{0.35};        ///< edge of a leaf cluster [m]
  double leaf_area{0.02};        ///< drag area of a leaf cluster [m^2]
  double leaf_mass{0.004};       ///< of a leaf cluster [kg]
  double flutter{0.25};          ///< largest turn of a leaf cluster in strong wind [rad]
  LeafShape leaf_shape{LeafShape::BROAD};
  Vec3 leaf_colour{Vec3(0.25, 0.45, 0.12)};      ///< sRGB, 0 to 1
  Vec3 leaf_colour_young{Vec3(0.45, 0.6, 0.2)};  ///< outer leaves
  Vec3 bark_colour{Vec3(0.32, 0.25, 0.18)};
  Vec3 twig_colour{Vec3(0.3, 0.24, 0.15)};
  double turn{PI};       ///< largest turn of the trunk off the yaw of the tree [rad]
  double strength{0.0};  ///< bending stress at which physical branches break; 0: never [Pa]
  double fluid_density{AIR_DENSITY};        ///< of what flows around the tree [kg/m^3]
  std::vector<LimbRule> limbs{LimbRule{}};  ///< by recursion depth, trunk first

  int depths() const { return static_cast<int>(limbs.size()); }
};

/// Factors on every species that a user may change at run time (S1-10); 1 leaves the species as it
/// is.
struct Design {
  double size{1.0}, children{1.0}, leaves{1.0}, angle{1.0}, noise{1.0};
};

/// Factors on the motion of one tree, which its designer chooses (paper 1, section 3); 1 leaves the
/// species as it is.
struct TreeFactors {
  double stiffness{1.0};  ///< of all joints
  double damping{1.0};    ///< damping ratio of all joints
  double wind{1.0};       ///< drag, and so the load and the response in wind
};

void describe(FieldVisitor& visitor, Species& species);
/// Visits the fields that are not part of describe(), of which a usual species has the default.
void describeHabit(FieldVisitor& visitor, Species& species);
void describeStrength(FieldVisitor& visitor, Species& species);
void describeFluid(FieldVisitor& visitor, Species& species);
void describe(FieldVisitor& visitor, Design& design);
void describe(FieldVisitor& visitor, TreeFactors& factors);

/// Returns the largest angle [rad] between a limb and its parent for their ratio of diameters; it
/// falls linearly from angle_thin to angle_thick (S1-11).
double largestAngle(const Species& species, double relative_diameter);

/// Returns an upper bound of the distance of any tip from the foot of a tree of scale 1 [m]: limbs
/// reach at most as far as the longest chain of lengths, which check() bounds through `length`.
double sizeBound(const Species& species);

/// Returns the expected number of joints of a tree of scale 1.
double expectedBranches(const Species& species);

/// Adds a fault for each invalid value of a species.
void check(Species species, Faults& faults);

/// Returns the species with the factors applied, clamped to the ranges.
Species applyDesign(const Species& species, const Design& design);

/// Returns the species with the factors on its wood and drag, and with their values in its name.
Species applyFactors(const Species& species, const TreeFactors& factors);

/// Returns the species at a stage of growth from 0 (seedling) to 1 (as it is): sizes, limbs and
/// leaves times the factors of growthFactors(), clamped to the ranges.
Species applyStage(const Species& species, double stage);

/// Reads a species from YAML. Faults name path and key.
Species readSpecies(YamlSection section);
/// Returns the YAML of a species, from which readSpecies returns a species with the same bits.
std::string writeSpecies(const Species& species);
/// @throws InvalidInput with all faults.
Species parseSpecies(const std::string& yaml, const std::string& name);
Species loadSpecies(const std::string& file);

std::uint64_t hash(const Species& species);

}  // namespace vegetation_sim::forest
