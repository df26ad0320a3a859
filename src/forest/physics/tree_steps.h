// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "forest/physics/forest_physics.h"

namespace vegetation_sim::forest {

/// The equal steps between two ticks, in whole nanoseconds, so no rounding accumulates.
struct StepTimes {
  Nanoseconds from{0}, to{0};
  std::size_t count{0};

  Nanoseconds at(std::size_t i) const {
    return from + (to - from) * static_cast<Nanoseconds>(i) / static_cast<Nanoseconds>(count);
  }
};

/// The surroundings of a tick, which all trees share.
struct TickContext {
  const StepContext& forest;
  const PhysicsSettings& settings;
  const Bodies& bodies;
  StepTimes times;
};

/// Number of steps of 240 Hz that a step of a calm tree replaces: 60 Hz.
constexpr std::size_t CALM_STEPS = 4;
/// Time after which a tree is calm if nothing holds, pushes or touches it [s]: until then branches
/// that were released swing too fast for long steps. Steps of 60 Hz leave such a tree within 1 % of
/// its motion in wind (docs/charts/step_rate.png).
constexpr double CALM_AFTER = 2.0;

/// A reaction of a contact, and the step in which it began.
struct StepReaction {
  std::size_t step{0};
  Reaction reaction;
};

/// All steps of one tree between two ticks. Trees share no state, because each grab, push and
/// contact acts on one of them, so they step in any order with the same bits.
class TreeSteps {
 public:
  TreeSteps(std::uint32_t tree, PhysicalSubtree& subtree) : tree_(tree), subtree_(&subtree) {}
  std::uint32_t tree() const { return tree_; }
  std::size_t branchCount() const { return subtree_->joints().size(); }
  void add(HeldGrab& grab) { grabs_.push_back(&grab); }  ///< in the order of their ids
  void add(const Push& push) { pushes_.push_back(&push); }
  /// Bodies may touch the tree.
  void setContacts(PersistentContacts& contacts) { contacts_ = &contacts; }

  /// Returns the steps of this tree: those of the tick, or fewer if the tree is calm and its steps
  /// are linearly implicit ones.
  StepTimes timesIn(const TickContext& tick) const;
  /// Takes all steps of `tick`, sums what they did to grabs and bodies, and demotes branches.
  void run(const TickContext& tick, SubtreeScratch& scratch);

  /// Mean forces over the tick on the holders of grabs.
  const std::vector<Reaction>& grabReactions() const { return grab_reactions_; }
  /// Sums over the steps of the forces on bodies, in the order in which they began.
  const std::vector<StepReaction>& contactReactions() const { return contact_reactions_; }
  /// Returns whether a step needed more bisections than allowed.
  std::size_t coarseSteps() const { return coarse_; }

 private:
  struct Run;
  void collectSprings(const StepTimes& times);
  void setPushes(Nanoseconds from, Nanoseconds to);
  void step(const Run& run, std::size_t k);
  void stepNearBodies(const Run& run, std::size_t k);
  void substep(const Run& run, const ContactTree& tree, std::size_t k, Nanoseconds from,
               Nanoseconds to, SubstepBisection& bisection);
  void accumulateImpulses(const TreeWind& air, SubtreeScratch& scratch, Nanoseconds from,
                          Nanoseconds to);
  void accumulateImpulse(const SubtreeSpring* springs, const Vec3* places, Nanoseconds from,
                         Nanoseconds to, HeldGrab& grab) const;
  void accumulateReactions(std::size_t k, const std::vector<Reaction>& reactions);
  void recordGrabs(double duration);

  std::uint32_t tree_;
  PhysicalSubtree* subtree_;
  std::vector<HeldGrab*> grabs_;
  std::vector<const Push*> pushes_;
  PersistentContacts* contacts_{nullptr};
  SubtreeLoads loads_;
  std::vector<Reaction> grab_reactions_;
  std::vector<StepReaction> contact_reactions_;
  std::size_t coarse_{0};
};

}  // namespace vegetation_sim::forest
