// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "vegetation_sim/core/math/time.h"
#include "vegetation_sim/core/math/vectors.h"
#include "vegetation_sim/tree/growth/forest_layout.h"

namespace vegetation_sim::forest {

/// One joint and the straight piece of wood that it carries; a limb has several.
struct Branch {
  int parent{-1};           ///< index of the parent, below the own index; -1: the ground
  int next{-1};             ///< index of the next branch of the same limb; -1: none
  int depth{0};             ///< recursion depth of its limb: 0 is the trunk
  double h{0.0};            ///< position of its joint along its parent [m]
  double theta{0.0};        ///< rest turn about the parent's z, paper 1 fig. 1 [rad]
  double phi{0.0};          ///< rest turn about the own y [rad]
  double length{0.0};       ///< [m]
  double base_radius{0.0};  ///< [m]
  double tip_radius{0.0};   ///< [m]
  double roll{0.0};      ///< turn about z that removes the twist along the limb, for meshes [rad]
  int leaves{0};         ///< leaf clusters on it
  bool broken{false};    ///< has come off the tree, see breakOff()
  std::uint64_t key{0};  ///< key of its random numbers
  Quat turn;             ///< Rz(theta) Ry(phi): its joint at rest, in its parent's frame
  Pose rest;             ///< at rest, in the tree's frame: origin at the foot, axes as the world's
};

/// Branches of one depth and one position in their limbs. None is a parent of another, so all can
/// be posed at once; their parents are in earlier groups.
struct Group {
  int begin{0}, end{0}, depth{0};
};

/// A tree grown from its seed, at rest. Sorted by groups, so the joints of the first n depths are
/// the first depth_end[n - 1] branches.
struct Skeleton {
  std::vector<Branch> branches;
  std::vector<Group> groups;
  std::vector<int> depth_end;  ///< per depth: one past its last branch
  double height{0.0};          ///< of the highest tip above the foot [m]
  double reach{0.0};           ///< of the farthest tip from the trunk's axis, horizontally [m]
  double trunk_radius{0.0};    ///< at the foot of the trunk [m]
  bool rooted{true};           ///< its first branch stands in the ground; false: a piece

  int depths() const { return static_cast<int>(depth_end.size()); }
  std::uint64_t hash() const;
};

/// Grows a tree. A pure function of seed and species, with the same bits on every machine (S1-04,
/// S1-07).
Skeleton grow(const TreeSeed& seed, const Species& species);

/// Returns the number of branches that grow() makes, in a fraction of its time.
std::size_t countBranches(const TreeSeed& seed, const Species& species);

/// Returns the factor on the height and trunk radius of the species with which grow() makes the
/// trunk of a tree.
double trunkScale(const TreeSeed& seed, const Species& species);

/// A branch that has come off its tree at its joint, with all that it carried. Its first motion is
/// that of its joint at the tick at which it came off.
struct BrokenBranch {
  int branch{1};                ///< never 0, the foot of the trunk
  Nanoseconds stamp{0};         ///< of the first tick without it
  bool cut{false};              ///< by a request; false: it broke
  Pose pose;                    ///< of its joint, world
  Vec3 velocity{Vec3::Zero()};  ///< of its joint, world [m/s]
  Vec3 spin{Vec3::Zero()};      ///< world [rad/s]
};
bool operator==(const BrokenBranch& a, const BrokenBranch& b);

/// What has come off one tree, earliest first. What a piece had lost before is not part of it.
using BrokenBranches = std::vector<BrokenBranch>;
/// The entries are sorted by tree; trees without any are not listed.
using BrokenTrees = std::map<std::uint32_t, BrokenBranches>;
/// Returns what has come off a tree; empty for a tree that is not listed.
const BrokenBranches& brokenOf(const BrokenTrees& trees, std::uint32_t tree);

/// Takes broken branches off a skeleton. Indices stay: a branch that is gone keeps its joint and is
/// shrunk to a thousandth without leaves, so that nothing sees it and masses stay above 0. Height
/// and reach stay as they were.
/// @throws InvalidInput for a branch that the tree does not have, and for its foot.
void breakOff(const BrokenBranches& broken, Skeleton& skeleton);

/// Keeps of a skeleton only a branch, which becomes the first, and what it carries that has not
/// come off. Height, reach and radius of the trunk stay those of the tree.
/// @return the index that each branch had before, rising.
/// @throws InvalidInput for a branch that the tree does not have, and for its foot.
std::vector<int> keepPiece(int branch, Skeleton& skeleton);

/// Returns Rz(theta) Ry(phi), the rotation of a child in the frame of its parent.
Quat restRotation(double theta, double phi);

/// Returns the end of a branch's axis in the frame of `pose`.
Vec3 tipOf(const Branch& branch, const Pose& pose);

}  // namespace vegetation_sim::forest
