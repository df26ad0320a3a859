// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/growth/branch_mass.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

Skeleton bar(double length, double diameter) {
  Branch branch;
  branch.length = length;
  branch.base_radius = branch.tip_radius = 0.5 * diameter;
  Skeleton out;
  out.branches = {branch};
  return out;
}

Skeleton oak() {
  return grow(gridLayout(1, 1.0).trees[0], shippedSpecies("oak"));
}

constexpr double SIZES[5][2] = {{1.0, 0.1}, {2.0, 0.1}, {0.5, 0.05}, {0.3, 0.004}, {4.0, 0.3}};

// S1-W2, E13: a slender bar on its joint oscillates with w0 = sqrt(3 E / rho) d / (4 l^2).
TEST(BranchMass, BeamsSwingAsThickAsTheyAreAndAsShortSquared) {
  const Species species = shippedSpecies("oak");
  for (const auto& [length, diameter] : SIZES) {
    const Wood wood = woodOf(bar(length, diameter), species, Material::BEAM);
    const double expected = std::sqrt(3.0 * species.youngs_modulus / species.density) * diameter /
                            (4.0 * length * length);
    // A bar with a diameter of a tenth of its length has a larger inertia by 3/16 d^2 / l^2.
    EXPECT_NEAR(std::sqrt(wood.stiffness[0] / wood.own[0].inertia[0]), expected, 1e-3 * expected);
    EXPECT_NEAR(wood.damping[0],
                2.0 * species.damping_ratio * std::sqrt(wood.stiffness[0] * wood.own[0].inertia[0]),
                1e-12 * wood.damping[0]);
  }
}

// S1-28, S1-29: k / m ~ 1 / l^2 for any diameter, nu ~ k.
TEST(BranchMass, PaperMaterialSwingsWithoutRegardToThickness) {
  const Species species = shippedSpecies("oak");
  const double scale = species.youngs_modulus * PAPER_RADIUS * PAPER_RADIUS / 4.0 / species.density;
  for (const auto& [length, diameter] : SIZES) {
    const Wood wood = woodOf(bar(length, diameter), species, Material::PAPER);
    const double squared = wood.stiffness[0] / wood.own[0].mass;
    EXPECT_NEAR(squared * length * length, scale, 1e-9 * scale);
    EXPECT_NEAR(wood.damping[0] / wood.stiffness[0], species.damping_ratio * PAPER_DAMPING, 1e-15);
  }
}

// The reference: mass, moment and inertia about a joint, summed over points along the branches.
TEST(BranchMass, SubtreesWeighWhatTheirPartsWeigh) {
  const Skeleton skeleton = oak();
  const Wood wood = woodOf(skeleton, shippedSpecies("oak"), Material::BEAM);
  const std::size_t root = 3;
  const Pose& at = skeleton.branches[root].rest;
  double mass = 0.0, zz = 0.0;
  Vec3 moment = Vec3::Zero();
  for (std::size_t i = root; i < skeleton.branches.size(); ++i) {
    int bearer = static_cast<int>(i);
    while (bearer > static_cast<int>(root)) bearer = skeleton.branches[bearer].parent;
    if (bearer != static_cast<int>(root)) continue;
    const Branch& b = skeleton.branches[i];
    const double m = wood.own[i].mass;
    mass += m;
    const auto place = [&](double f) {
      return rotate(conjugate(at.orientation),
                    Vec3(b.rest.position + f * b.length * axisZ(b.rest.orientation) - at.position));
    };
    moment += m * place(0.5);
    for (const double f : {0.0, 0.5, 1.0}) {  // Simpson's rule is exact for a bar
      const Vec3 p = place(f);
      zz += m * (f == 0.5 ? 4.0 : 1.0) / 6.0 * (p.x() * p.x() + p.y() * p.y());
    }
  }
  EXPECT_NEAR(wood.subtree[root].mass, mass, 1e-9 * mass);
  EXPECT_LT(length(wood.subtree[root].moment - moment), 1e-9 * length(moment));
  EXPECT_NEAR(wood.subtree[root].inertia[2], zz, 1e-2 * zz);  // points have no thickness
}

// S1-W9: unpromoted wood is carried by promoted wood; nothing is lost.
TEST(BranchMass, ClustersLoseNothing) {
  const Skeleton skeleton = oak();
  const Wood wood = woodOf(skeleton, shippedSpecies("oak"), Material::BEAM);
  std::vector<char> promoted(skeleton.branches.size(), 0);
  for (const std::size_t i : {0u, 1u, 2u, 7u}) promoted[i] = 1;
  std::vector<Composite> clusters;
  clusterWood(skeleton, wood.own, promoted, clusters);
  double mass = 0.0, drag = 0.0;
  for (std::size_t i = 0; i < promoted.size(); ++i) {
    if (!promoted[i]) continue;
    mass += clusters[i].mass;
    drag += clusters[i].drag;
  }
  EXPECT_NEAR(mass, wood.subtree[0].mass, 1e-9 * mass);
  EXPECT_NEAR(drag, wood.subtree[0].drag, 1e-9 * drag);
  promoted.assign(promoted.size(), 1);
  clusterWood(skeleton, wood.own, promoted, clusters);
  for (std::size_t i = 0; i < promoted.size(); ++i) EXPECT_EQ(clusters[i].mass, wood.own[i].mass);
}

TEST(BranchMass, LeavesWeigh) {
  Species species = shippedSpecies("oak");
  const Skeleton skeleton = oak();
  species.leaf_mass = 0.0;
  const double bare = woodOf(skeleton, species, Material::BEAM).subtree[0].mass;
  species.leaf_mass = 0.01;
  int leaves = 0;
  for (const Branch& b : skeleton.branches) leaves += b.leaves;
  ASSERT_GT(leaves, 0);
  EXPECT_NEAR(woodOf(skeleton, species, Material::BEAM).subtree[0].mass, bare + 0.01 * leaves,
              1e-9 * bare);
}

}  // namespace
}  // namespace vegetation_sim::forest
