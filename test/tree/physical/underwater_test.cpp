// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// N11: a tree in water against beam theory, in the forest's physics and in its modes.
#include <gtest/gtest.h>

#include "scenes/forest/physics_scene.h"
#include "vegetation_sim/tree/growth/response.h"
#include "vegetation_sim/tree/modal/modal_tree.h"

namespace vegetation_sim::forest {
namespace {

constexpr double SEA_WATER = 1025.0;  // [kg/m^3]

/// An upright cylinder of equal segments that is fixed at its foot.
struct Cylinder {
  static constexpr int SEGMENTS = 16;
  static constexpr double LENGTH = 1.5, RADIUS = 0.01;  // [m]
  PhysicsRig rig;

  static Layout layout(double fluid_density, double drag_coefficient) {
    Layout out = gridLayout(1, 12.0);
    Species species;
    species.name = "cylinder";
    species.height = LENGTH;
    species.trunk_radius = RADIUS;
    species.twig_radius = 0.001;
    species.height_variation = species.lean = species.noise = 0.0;
    species.slenderness = 5000.0;
    species.youngs_modulus = 1e9;
    species.density = 700.0;
    species.damping_ratio = 0.002;
    species.drag_coefficient = drag_coefficient;
    species.reference_speed = 0.5;
    species.fluid_density = fluid_density;
    LimbRule trunk;
    trunk.segments = SEGMENTS;
    trunk.taper = 1.0;
    trunk.wander = 0.0;
    species.limbs = {trunk};
    out.species = {species};
    for (TreeSeed& seed : out.trees) seed.species = 0;
    out.motion.drag = Drag::QUADRATIC;
    return out;
  }
  static PhysicsSettings settings() {
    PhysicsSettings out;
    out.promotion = Promotion::DEPTH;
    out.precision = Precision::DOUBLE;  // deflections in air are a few hundredths of a millimetre
    out.influence_tolerance = 1e-6;     // keeps all joints physical
    out.linger = 60.0;
    return out;
  }
  explicit Cylinder(double fluid_density, double drag_coefficient = 0.0)
      : rig(layout(fluid_density, drag_coefficient), settings()) {}

  const Species& species() const { return rig.forest.layout().species[0]; }
  double tipX() const { return tipsOf(rig).back().x(); }
  /// E I of the solid round bar [N m^2].
  double bending() const {
    return species().youngs_modulus * PI * RADIUS * RADIUS * RADIUS * RADIUS / 4.0;
  }
};

// Pulls the tip aside, lets go, and returns the mean angular frequency of twelve half swings
// [rad/s].
double swingOf(Cylinder& cylinder) {
  PhysicsRig& rig = cylinder.rig;
  Grab grab = rig.grabOf(Cylinder::SEGMENTS - 1);
  grab.stiffness = 500.0;
  grab.damping = 20.0;
  grab.target.x() += 0.05;
  const std::uint32_t id = rig.forest.addGrab(grab);
  rig.run(2.0);
  EXPECT_GT(cylinder.tipX(), 0.03);
  rig.forest.release(id);
  std::vector<double> crossings;
  double before = cylinder.tipX();
  for (int i = 1; i < 20 * TICK_RATE && crossings.size() < 13; ++i) {
    rig.advance();
    const double now = cylinder.tipX();
    if ((before > 0.0) != (now > 0.0)) crossings.push_back((i - now / (now - before)) / TICK_RATE);
    before = now;
  }
  EXPECT_EQ(crossings.size(), 13u);
  return 12.0 * PI / (crossings.back() - crossings.front());
}

// Euler and Bernoulli with the added mass of a cylinder in cross flow (Blevins, Formulas for
// Natural Frequency and Mode Shape, 1979): w = 3.516 sqrt(E I / (A (rho + rho_fluid) L^4)), so
// water lowers it by sqrt(rho / (rho + rho_fluid)). The joint of the foot bends as much as half a
// segment more of the beam. Tolerances: 0.5 % of the ratio, for higher modes and the interpolation
// of crossings; 1 % of the value, for what else is off in 16 joints.
TEST(Underwater, SwingsSlowerByTheAddedMass) {
  Cylinder air(AIR_DENSITY), water(SEA_WATER);
  const double in_air = swingOf(air), in_water = swingOf(water);
  const double wood = air.species().density;
  const double theory = std::sqrt(wood / (wood + SEA_WATER));
  std::printf("%.4f rad/s in air, %.4f in water: ratio %.5f, theory %.5f\n", in_air, in_water,
              in_water / in_air, theory);
  EXPECT_NEAR(in_water / in_air, theory, 0.005 * theory);
  for (const auto& [cylinder, measured] : {std::pair(&air, in_air), std::pair(&water, in_water)}) {
    const double fluid = cylinder == &water ? SEA_WATER : 0.0;
    const double mass = PI * Cylinder::RADIUS * Cylinder::RADIUS * (wood + fluid);  // [kg/m]
    const double span = Cylinder::LENGTH * (1.0 + 0.5 / Cylinder::SEGMENTS);
    const double beam = 3.516 * std::sqrt(cylinder->bending() / mass) / (span * span);
    EXPECT_NEAR(measured, beam, 0.01 * beam);
  }
}

// The drag q = rho Cd d u^2 / 2 per length of a slow current bends a beam by q L^4 / (8 E I), in a
// chain of N joints times (1 + 1/N)^2. Tolerance: 1 %, for the turn of the drag with the beam.
TEST(Underwater, BendsInACurrentByTheRatioOfDensities) {
  constexpr double SPEED = 0.1, DRAG = 1.1;
  double bend[2], shown[2];
  for (const bool wet : {false, true}) {
    const double fluid = wet ? SEA_WATER : AIR_DENSITY;
    Cylinder cylinder(fluid, DRAG);
    PhysicsRig& rig = cylinder.rig;
    wind::Primitive current = makeBreeze(1, Vec3(SPEED, 0.0, 0.0));
    current.turbulence = 0.0;
    rig.forest.setWind(wind::Field({current}));
    rig.run(1.0);
    shown[wet] = cylinder.tipX();
    rig.touch(Cylinder::SEGMENTS - 1, 60.0);
    rig.run(5.0);
    ASSERT_EQ(rig.forest.physicsFigures().branches, std::size_t{Cylinder::SEGMENTS});
    bend[wet] = cylinder.tipX();
    const double load = 0.5 * fluid * DRAG * 2.0 * Cylinder::RADIUS * SPEED * SPEED;
    const double joints = 1.0 + 1.0 / Cylinder::SEGMENTS,
                 length2 = Cylinder::LENGTH * Cylinder::LENGTH;
    const double theory = load * length2 * length2 / (8.0 * cylinder.bending()) * joints * joints;
    std::printf("%s: tip at %.5f mm, physical %.5f mm, theory %.5f mm\n", wet ? "water" : "air",
                1e3 * shown[wet], 1e3 * bend[wet], 1e3 * theory);
    EXPECT_NEAR(bend[wet], theory, 0.01 * theory);
    EXPECT_NEAR(shown[wet], theory, 0.01 * theory);
  }
  EXPECT_NEAR(bend[1] / bend[0], SEA_WATER / AIR_DENSITY, 0.01 * SEA_WATER / AIR_DENSITY);
  EXPECT_NEAR(shown[1] / shown[0], SEA_WATER / AIR_DENSITY, 0.01 * SEA_WATER / AIR_DENSITY);
}

// The frequencies of the modes of an oak fall alike. Tolerance: modes are accurate to 1e-4, and the
// turn of a branch about itself carries no fluid.
TEST(Underwater, ModesOfATreeAreSlowerByTheAddedMass) {
  Species species = shippedSpecies("oak");
  const Layout layout = PhysicsRig::makeLayout(1, "oak");
  const Tree tree = growTree(layout, 0, terrain::HeightMap());
  const std::vector<double> dry = ModalTree(tree, species).modes().frequency;
  species.fluid_density = SEA_WATER;
  const std::vector<double> wet = ModalTree(tree, species).modes().frequency;
  const double theory = std::sqrt(species.density / (species.density + SEA_WATER - AIR_DENSITY));
  ASSERT_EQ(wet.size(), dry.size());
  EXPECT_NEAR(wet[0] / dry[0], theory, 1e-3 * theory);
}

}  // namespace
}  // namespace vegetation_sim::forest
