// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/forest/skeleton.h"

namespace vegetation_sim::forest {

/// One joint of a physical tree and the wood that it carries, built from geometry when the tree
/// becomes physical (S1-25).
struct PhysicalBranch {
  int parent{-1};              ///< index below the own; -1: the ground
  double h{0.0};               ///< of the joint along the parent [m]
  Quat rest{};                 ///< rest rotation in the parent's frame
  double length{1.0};          ///< [m]
  double mass{1.0};            ///< [kg]
  double centre{0.5};          ///< of mass, along the own z from the joint [m]
  double inertia_across{1.0};  ///< about an axis through the joint, perpendicular to z [kg m^2]
  double inertia_along{0.0};   ///< about z [kg m^2]
  double stiffness{1.0};       ///< [N m/rad]
  double damping{0.0};         ///< [N m s/rad]
};

/// Wood as a beam: k = E I / l, solid bar of the species' density (S1-W2, E13); leaves weigh
/// nothing. Damping is set from `damping_ratio` and the inertia of the sub-tree about the joint.
std::vector<PhysicalBranch> beamTree(const Skeleton& skeleton, const Species& species,
                                     double damping_ratio);

/// Angles and rates of all joints: bends about the own rest x and y axes [rad], [rad/s].
struct PhysicalState {
  std::vector<Eigen::Vector2d> q, rate;
};

/// Force and torque about the joint that act on a branch from outside, world axes [N], [N m].
struct Wrench {
  Vec3 force{Vec3::Zero()}, torque{Vec3::Zero()};
};

/// Where the branches are and how they move, world axes.
struct Kinematics {
  std::vector<Pose> pose;
  std::vector<Vec3> spin;      ///< angular velocity [rad/s]
  std::vector<Vec3> velocity;  ///< of the joint [m/s]
};
Kinematics kinematicsOf(const std::vector<PhysicalBranch>& tree, const PhysicalState& state);

/// Mechanical energy: kinetic plus springs [J].
double energyOf(const std::vector<PhysicalBranch>& tree, const PhysicalState& state);

/// Spring, damper and theta scheme that an implicit step folds into the joint-space inertia: the
/// joint torque is -k (q + first * rate + second * acceleration) - nu (rate + third *
/// acceleration).
struct Implicitness {
  double first{0.0}, second{0.0}, third{0.0};
};

/// Accelerations of all joints of the full articulated chain, with inertia, reaction forces,
/// gyroscopic terms and lever arms: Featherstone's articulated-body algorithm, O(N), exact for any
/// angle below pi. `loads` per branch. Plain double version: the reference of any faster one.
std::vector<Eigen::Vector2d> articulatedAccelerations(const std::vector<PhysicalBranch>& tree,
                                                      const PhysicalState& state,
                                                      const std::vector<Wrench>& loads,
                                                      const Implicitness& implicitness = {});

}  // namespace vegetation_sim::forest
