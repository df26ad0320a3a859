// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tree/growth/wood.h"

namespace vegetation_sim::forest {

/// A force at a point of a branch, world axes.
struct BranchLoad {
  int branch{0};
  double along{0.0};         ///< [m]
  Vec3 force{Vec3::Zero()};  ///< [N]
};

/// How far loads move the tree by each joint [m]: its bend times the reach of what it bears (N12,
/// S1-W8). On the way to the ground the bend is the static one, lever x force / k; there a joint
/// counts with all that count less, so that leaving out those below a tolerance misplaces the
/// loaded point by no more. Everywhere else, and there on top, it is what the wood's own inertia
/// does when the loads come or go at once: the tree swings with u cos(w t), u the static
/// displacement and w Rayleigh's frequency of that shape.
std::vector<double> predictDeflection(const Skeleton& skeleton, const Wood& wood,
                                      const std::vector<BranchLoad>& loads);

/// Displacement of a branch's point per force along a unit direction, all joints together [m/N].
double compliance(const Skeleton& skeleton, const Wood& wood, int branch, double along,
                  const Vec3& direction);

/// The branches that shall be physical, rising.
struct Selection {
  std::vector<int> branches;
  std::size_t refused{0};  ///< wanted and not physical, but beyond the cap
};

/// Branches whose score is above `threshold`, or above `keep` where they are physical already
/// (`promoted`, per branch; hysteresis), and whatever lies between two of them; the highest scores
/// first, at most `cap`, and only as many new ones as find room beside all that is physical.
Selection selectBranches(const Skeleton& skeleton, const std::vector<double>& score,
                         double threshold, double keep, const std::vector<char>& promoted,
                         std::size_t cap);

/// Scores of the paper's rule (S1-43): 1 and less, falling from the ground on, for every joint not
/// deeper than the deepest loaded one; 0 for all others.
std::vector<double> scoreByDepth(const Skeleton& skeleton, const std::vector<int>& loaded);

/// Score of a loaded branch: above any other.
constexpr double LOADED = 1e30;

}  // namespace vegetation_sim::forest
