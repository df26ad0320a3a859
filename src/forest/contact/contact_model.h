// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tree/physical/interaction.h"

namespace vegetation_sim::physics {
struct Contact;
struct ContactLaw;
class ContactStepper;
struct Kinematics;
}  // namespace vegetation_sim::physics

namespace vegetation_sim::forest {

class Forest;
struct Skeleton;

using Bodies = std::map<std::string, Body>;
/// Branches by tree.
using BranchesOfTrees = std::map<std::uint32_t, std::vector<int>>;

/// What is known of a branch near a body from one step to the next; state of the tree's part.
struct Touch {
  std::string body;
  int branch{0};
  Vec3 side{Vec3::Zero()};  ///< of the body on which the branch is: unit, the body's axes
  double gap{0.0};          ///< at the start of the last step [m]
  double force{0.0};        ///< of the last step [N]
  double along{0.0};        ///< where on the branch [m]
  bool leaving{false};      ///< the branch has slid off there, and the force falls
};
/// By body, then branch; rising. A branch that lies flat on a body has two.
using Touches = std::vector<Touch>;

/// Of one step of a tree: which of its parts are taken again in halves, so that the
/// forces on a branch change by at most MAX_FORCE_CHANGE of the law's limit in a part.
class SubstepBisection {
 public:
  static constexpr double MAX_FORCE_CHANGE = 0.25;
  static constexpr Nanoseconds SHORTEST = 4000;  ///< of a part
  static constexpr int MOST = 128;               ///< in a step

  /// True if the last step of `stepper`, a part so long, was too coarse and may be halved.
  bool want(const physics::ContactStepper& stepper, const physics::ContactLaw& law,
            Nanoseconds part);
  /// True if more were wanted.
  bool ranOut() const { return wanted_ > MOST; }

 private:
  int wanted_{0};
};

/// How bodies touch trees. What it remembers changes nothing that it finds.
///
/// A step of a tree with contacts is taken in `partsOf` equal parts. Each: `findContacts` at its
/// start; if there are any, `physics::ContactStepper` instead of the stepper's own step. Where that
/// is too coarse: back, and in two halves instead; else `settle`.
class ContactModel {
 public:
  virtual ~ContactModel() = default;

  /// Adds the branches that bodies may touch until `to`: they are made physical at `from`, before
  /// they are touched, and stay so while they are named. Called once a tick, before its steps.
  virtual void findNear(const Forest& forest, const Bodies& bodies, Nanoseconds from,
                        Nanoseconds to, BranchesOfTrees& near) const = 0;

  /// The physical wood of one tree at the start of a step: link i is a branch. Poses in the tree's
  /// frame (foot at the origin, axes as the world's).
  struct Wood {
    std::uint32_t tree{0};
    Vec3 foot{Vec3::Zero()};           ///< world [m]
    const std::vector<int>& branches;  ///< [links]
    const Skeleton& skeleton;
    const physics::Kinematics& start;  ///< [links]
  };
  /// Into how many equal parts the step [from, to] is taken, so that wood near a body moves little
  /// in each.
  virtual int partsOf(const Wood& wood, const Bodies& bodies, Nanoseconds from,
                      Nanoseconds to) const = 0;
  /// Contacts that the step [from, to] has or may have. Touches that are over are dropped.
  virtual std::vector<physics::Contact> findContacts(const Wood& wood, const Bodies& bodies,
                                                     Nanoseconds from, Nanoseconds to,
                                                     Touches& touches) const = 0;
  /// After the step: keeps the forces; adds one reaction per contact that bears.
  virtual void settle(const Wood& wood, const Bodies& bodies,
                      const std::vector<physics::Contact>& contacts, Nanoseconds to,
                      Touches& touches, std::vector<Reaction>& reactions) const = 0;
  /// Called instead of findNear where there is nothing to look for: forgets what it remembers.
  virtual void releaseTrees() const {}
  /// Held for what it remembers.
  virtual std::size_t bytes() const { return 0; }
};

}  // namespace vegetation_sim::forest
