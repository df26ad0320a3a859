// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tree/growth/wood.h"
#include "vegetation_sim/tree/modal/modal_tree.h"

namespace vegetation_sim::forest {

/// What the air holds on to: drag and its centre, per branch with leaves or wood.
struct WindLoadPoint {
  std::size_t branch;
  double drag;  // [kg/s]
  Vec3 arm;     // from the joint, tree's axes
  Vec3 centre;  // tree's frame
};

std::vector<WindLoadPoint> windLoadPoints(const Skeleton& skeleton, const Wood& wood);

using Motions = std::vector<std::vector<physics::SmallMotion>>;  // [modes][links]

/// How far the centre of a sail goes per amplitude.
Vec3 wayOf(const WindLoadPoint& load_point, const std::vector<physics::SmallMotion>& motion);

/// Joint torques of a uniform wind of 1 m/s.
std::vector<double> uniformLoad(const physics::LinearChain& chain,
                                const std::vector<WindLoadPoint>& load_points,
                                const Vec3& direction);

/// [3][row] modal loads per velocity of the same air on all sails [kg/s].
std::vector<double> uniformWindLoad(const std::vector<WindLoadPoint>& load_points,
                                    const Motions& motions);

/// The crown in halves of equal drag, again and again; puts the sails in their order.
WindPoints pointsOf(std::vector<WindLoadPoint>& load_points, const Motions& motions, int bisection);

/// How uniformPush() changes as the tree bends, to the first order: [modes][3][row] per amplitude
/// of each mode [kg/s]. Levers turn with the branches that bear them; the change is symmetric.
std::vector<double> leverArmChange(const std::vector<physics::Link>& links,
                                   const physics::LinearChain& chain, const physics::Modes& modes,
                                   const std::vector<WindLoadPoint>& load_points,
                                   const Motions& motions);

}  // namespace vegetation_sim::forest
