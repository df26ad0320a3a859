// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tree/growth/branch_mass.h"

namespace vegetation_sim::forest {

/// A branch as an index of an array.
inline std::size_t index(int branch) {
  return static_cast<std::size_t>(branch);
}

/// A force at a point of a branch, world axes.
struct BranchLoad {
  int branch{0};
  double along{0.0};         ///< [m]
  Vec3 force{Vec3::Zero()};  ///< [N]
};

/// Returns how far each joint moves the tree under loads [m]: its bend times the reach of its
/// sub-tree (N12, S1-W8). Between a load and the ground the bend is the static one, lever x force /
/// k, and a joint counts with the sum of all smaller ones, so that leaving out joints below a
/// tolerance misplaces the loaded point by at most this tolerance. Added everywhere is the bend by
/// the inertia of the wood when loads start or end suddenly: the tree oscillates with u cos(w t),
/// where u is the static displacement and w Rayleigh's frequency of that shape.
std::vector<double> predictDeflection(const Skeleton& skeleton, const Wood& wood,
                                      const std::vector<BranchLoad>& loads);

/// Returns the displacement of a point of a branch per force along a unit direction, over all
/// joints [m/N].
double compliance(const Skeleton& skeleton, const Wood& wood, int branch, double along,
                  const Vec3& direction);

/// The branches to be physical, sorted.
struct Selection {
  std::vector<int> branches;
  std::size_t refused{0};  ///< requested and not physical, because of the cap
};

/// Selects branches whose score is above `threshold`, or above `keep` where they are physical
/// already (`promoted`, per branch; hysteresis), and all branches between two of them. The highest
/// scores come first, at most `cap`, and new ones only as room permits.
Selection selectBranches(const Skeleton& skeleton, const std::vector<double>& score,
                         double threshold, double keep, const std::vector<char>& promoted,
                         std::size_t cap);

/// Returns the scores of the paper's rule (S1-43): 1 and less, decreasing from the ground on, for
/// every joint not deeper than the deepest loaded one; 0 for all others.
std::vector<double> scoreByDepth(const Skeleton& skeleton, const std::vector<int>& loaded);

/// Score of a loaded branch: above any other.
constexpr double LOADED = 1e30;

}  // namespace vegetation_sim::forest
