// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "tree/growth/physics_settings.h"
#include "vegetation_sim/tree/growth/skeleton.h"

namespace vegetation_sim::forest {

/// Mass properties of rigid wood about a joint, in the axes of its branch, added mass included.
struct Composite {
  double mass{0.0};                 ///< [kg]
  Vec3 moment{Vec3::Zero()};        ///< mass times centre of mass [kg m]
  std::array<double, 6> inertia{};  ///< xx, yy, zz, xy, xz, yz about the joint [kg m^2]
  double drag{0.0};                 ///< force per speed of the fluid [kg/s]
  Vec3 drag_moment{Vec3::Zero()};   ///< drag times its centre [kg m/s]

  /// Returns the same wood seen from a parent joint: `turn` is the rotation of its axes there,
  /// `offset` its origin.
  Composite movedBy(const Quat& turn, const Vec3& offset) const;
  void add(const Composite& other);
};

/// Physical properties of every branch of a tree, computed from its geometry when it is touched
/// (S1-25).
struct Wood {
  double added_mass{0.0};          ///< of the fluid, over that of the wood
  std::vector<Composite> own;      ///< of the branch with its leaves
  std::vector<Composite> subtree;  ///< of the whole sub-tree at rest
  std::vector<double> stiffness;   ///< of the joint [N m/rad]
  std::vector<double> damping;     ///< of the joint [N m s/rad]
  std::vector<double> reach;       ///< of the farthest tip of the sub-tree from the joint [m]
};

/// Computes the wood of a tree. `beam`: k = E I / l of a solid bar (E13, S1-W2), damping from the
/// species' ratio and the inertia of the sub-tree. `paper`: m ~ l d^2 and k ~ d^2 / l (S1-28,
/// S1-29), as stiff as the beam at PAPER_RADIUS, nu = ratio * PAPER_DAMPING * k.
Wood woodOf(const Skeleton& skeleton, const Species& species, Material material);

/// Returns the mass of fluid that moves with wood and leaves, over their own: that of the displaced
/// volume (Morison, added-mass coefficient 1 of a cylinder in cross flow), beyond that of air,
/// which `density` includes. Leaves displace as much per mass as wood. It is also the weight that
/// the wood loses in the fluid, over its own.
double addedMass(const Species& species);

constexpr double PAPER_RADIUS = 0.02;  ///< [m]
constexpr double PAPER_DAMPING = 0.1;  ///< [s]

/// Computes for each branch its wood with all unpromoted wood that it carries at rest: clustering
/// (S1-W9). `own` and `promoted` are per branch.
void clusterWood(const Skeleton& skeleton, const std::vector<Composite>& own,
                 const std::vector<char>& promoted, std::vector<Composite>& out);

}  // namespace vegetation_sim::forest
