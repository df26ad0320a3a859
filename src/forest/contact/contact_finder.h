// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "dynamics/contact/contact_stepper.h"
#include "forest/contact/contact_body.h"
#include "tree/growth/tree_grid.h"
#include "tree/shards/tree_owners.h"
#include "vegetation_sim/tree/state/promoted_branches.h"

namespace vegetation_sim::forest {

/// Branches by tree.
using BranchesOfTrees = std::map<std::uint32_t, std::vector<int>>;

/// Contact of a body with a branch that persists from step to step. Part of the forest's state.
struct PersistentContact {
  std::string body;
  int branch{0};
  Vec3 normal{Vec3::Zero()};  ///< unit, from the body to the branch, in the body's axes
  double gap{0.0};            ///< at the start of the last step [m]
  double force{0.0};          ///< of the last step [N]
  double along{0.0};          ///< from the branch's base [m]
  bool released{false};       ///< the branch has slid off and the force decays
};
/// Sorted by body, then by branch. A branch that lies flat on a body has two.
using PersistentContacts = std::vector<PersistentContact>;

/// The forest whose trees are searched.
struct ContactScene {
  const Layout& layout;
  std::uint64_t layout_hash;
  const terrain::HeightMap& terrain;
  using Enters = std::function<bool(int branch, const Pose&)>;
  /// Returns poseReached() of a tree, in the tree's frame.
  std::function<ReachedPoses(const Tree&, std::uint32_t tree, Nanoseconds stamp, const Enters&)>
      pose;
  const TreeGrid* grid{nullptr};  ///< of the layout; null: all trees are compared with each body
  const BrokenTrees* broken{nullptr};  ///< what has come off the trees; null: nothing
  const TreeOwners* owners{nullptr};   ///< trees of other shards are ignored; null: there are none
};

/// The physical branches of one tree at the start of a step; link i is branches[i].
struct ContactTree {
  std::uint32_t tree{0};
  Vec3 foot{Vec3::Zero()};  ///< world [m]
  const std::vector<int>& branches;
  const Skeleton& skeleton;
  const physics::Kinematics& start;  ///< [links] in the tree's frame
};

/// Callbacks with the intermediate results of every substep, for tests and measurements.
struct ContactTrace {
  std::function<void(const ContactTree&, Nanoseconds from, const PersistentContacts&)> on_search;
  std::function<void(const ContactTree&, const std::vector<physics::Contact>&, Nanoseconds to)>
      on_step;
};

/// Finds the contacts of bodies with branches: over trees by their size, over branches by distance,
/// then exactly with both in motion (docs/contact.md). Caches the grown trees around bodies; the
/// cache does not change results.
///
/// A step of a tree takes `countSubsteps` equal substeps. Each calls `findContacts` at its start
/// and, if there are any, steps by `physics::ContactStepper`. If SubstepBisection finds the substep
/// too coarse, it is undone and repeated in two halves; otherwise `recordForces` follows.
class ContactFinder {
 public:
  explicit ContactFinder(ContactTrace trace = {}) : trace_(std::move(trace)) {}

  /// Adds the branches that bodies may touch from `from` to `to`, so that they become physical
  /// before they are touched.
  void findNear(const ContactScene& scene, const Bodies& bodies, Nanoseconds from, Nanoseconds to,
                BranchesOfTrees& near) const;
  /// Returns the number of equal substeps in which branches near a body move little.
  int countSubsteps(const ContactTree& tree, const Bodies& bodies, Nanoseconds from,
                    Nanoseconds to) const;
  /// Returns the contacts that are possible from `from` to `to`, and updates the persistent ones.
  std::vector<physics::Contact> findContacts(const ContactTree& tree, const Bodies& bodies,
                                             Nanoseconds from, Nanoseconds to,
                                             PersistentContacts& persistent) const;
  /// Stores the forces of the step that ended at `to` and adds one reaction per loaded contact.
  void recordForces(const ContactTree& tree, const Bodies& bodies,
                    const std::vector<physics::Contact>& contacts, Nanoseconds to,
                    PersistentContacts& persistent, std::vector<Reaction>& reactions) const;
  void releaseTrees() const;
  std::size_t bytes() const;

 private:
  struct CachedTree {
    std::shared_ptr<const Tree> tree;
    BrokenBranches broken;      // with which it was grown
    std::vector<double> reach;  // [branches] of all that each bears, however joints bend [m]
  };
  using Trees = std::map<std::uint32_t, CachedTree>;
  static const CachedTree& update(const ContactScene& scene, std::uint32_t id, CachedTree& cached);
  ContactTrace trace_;
  mutable std::mutex mutex_;
  mutable std::uint64_t layout_hash_{0};  // of trees_
  mutable Trees trees_;
};

/// Returns where a branch emerges from the wood of its parent, from its base [m].
double findExposedStart(const Skeleton& skeleton, int branch);

}  // namespace vegetation_sim::forest
