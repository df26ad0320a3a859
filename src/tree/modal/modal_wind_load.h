// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tree/growth/branch_mass.h"
#include "vegetation_sim/tree/modal/modal_tree.h"

namespace vegetation_sim::forest {

/// Drag of a branch and its centre.
struct WindLoadPoint {
  std::size_t branch;
  double drag;  // [kg/s]
  Vec3 arm;     // from the joint, tree's axes
  Vec3 centre;  // tree's frame
};

std::vector<WindLoadPoint> windLoadPoints(const Skeleton& skeleton, const Wood& wood);

using Motions = std::vector<std::vector<physics::SmallMotion>>;  // [modes][links]

/// Returns the displacement of the centre of drag per amplitude.
Vec3 wayOf(const WindLoadPoint& load_point, const std::vector<physics::SmallMotion>& motion);

/// Returns the joint torques of a uniform wind of 1 m/s.
std::vector<double> uniformLoad(const physics::LinearChain& chain,
                                const std::vector<WindLoadPoint>& load_points,
                                const Vec3& direction);

/// Returns [3][row] modal loads per velocity of a uniform wind [kg/s].
std::vector<double> uniformWindLoad(const std::vector<WindLoadPoint>& load_points,
                                    const Motions& motions);

/// Divides the crown `bisection` times into halves of equal drag; reorders the load points.
WindPoints pointsOf(std::vector<WindLoadPoint>& load_points, const Motions& motions, int bisection);

/// Returns the first-order change of uniformWindLoad() as the tree bends: [modes][3][row] per
/// amplitude of each mode [kg/s]. Lever arms rotate with the branches; the change is symmetric.
std::vector<double> leverArmChange(const std::vector<physics::Link>& links,
                                   const physics::LinearChain& chain, const physics::Modes& modes,
                                   const std::vector<WindLoadPoint>& load_points,
                                   const Motions& motions);

}  // namespace vegetation_sim::forest
