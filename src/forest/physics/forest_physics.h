// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "forest/contact/contact_model.h"
#include "tree/physical/interaction.h"
#include "tree/physical/physical_subtree.h"
#include "vegetation_sim/forest/physics/modal_forest.h"
#include "vegetation_sim/terrain/height_map.h"
#include "vegetation_sim/tree/state/level_map.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::forest {

/// The forest in which physics happens: nothing of it is kept.
struct StepContext {
  const Layout& layout;
  const terrain::HeightMap& terrain;
  const wind::Field& wind;
  const LevelMap& levels;
  const ModalForest& modes;
  const Forest& forest;
  const ContactModel* contacts{nullptr};
};

/// What a forest of this layout refuses of a grab, a target or a push, whatever else it holds;
/// `tree` is the one that is meant. All throw InvalidInput.
void checkGrab(const Layout& layout, const Tree& tree, const Grab& grab);
void checkTarget(const Tree& tree, const Vec3& target);
void checkPush(const Layout& layout, const Tree& tree, const Push& push);

/// What holds, pushes and touches the trees of a forest, and the parts of them that are physical
/// for it. A value: copy it to save. Requests are checked first and change nothing if refused; they
/// act from the last tick on.
class ForestPhysics {
 public:
  std::uint32_t addGrab(const StepContext& at, Grab grab);
  void moveGrab(std::uint32_t id, const Vec3& target);
  void renewGrab(std::uint32_t id);
  void release(std::uint32_t id);
  void push(const StepContext& at, const Push& push);
  void setBody(const Body& body);
  void removeBody(const std::string& id);
  void setSettings(const PhysicsSettings& settings, Nanoseconds now);
  /// @throws InvalidInput if a branch that `what` loads could not be physical now.
  void checkRoom(const std::string& what, std::uint32_t tree, int branch) const;
  /// Drops grabs, pushes, bodies and all that is physical.
  void clear();

  /// Steps from the last tick to this one: ceil(PHYSICS_RATE * time) equal steps.
  void advance(const StepContext& at, Nanoseconds from, Nanoseconds to);

  const PhysicsSettings& settings() const { return settings_; }
  const std::map<std::uint32_t, Grab>& grabs() const { return grabs_; }
  const Bodies& bodies() const { return bodies_; }
  const std::vector<Grab>& ended() const { return ended_; }
  const std::vector<Reaction>& reactions() const { return reactions_; }
  const std::map<std::uint32_t, PhysicalSubtree>& parts() const { return parts_; }
  PhysicsFigures figures() const;
  void addTo(Hash& hash) const;

 private:
  /// What a grab needs from one tick to the next.
  struct Hold {
    Vec3 target{Vec3::Zero()};   ///< at the last tick, world
    bool renewed{true};          ///< since the last tick
    double reach{0.0};           ///< its targets are no farther from the tree's foot [m]
    Vec3 foot{Vec3::Zero()};     ///< of the tree [m]
    Vec3 force{Vec3::Zero()};    ///< on the branch, mean of the last tick [N]
    Vec3 place{Vec3::Zero()};    ///< of the point held, from the tree's foot [m]
    Vec3 impulse{Vec3::Zero()};  ///< on the branch since the last tick [N s]
    bool limited{false};         ///< at its limit somewhere since then
  };

  PhysicalSubtree& partOf(const StepContext& at, std::uint32_t tree);
  TreeWind airOf(const StepContext& at, std::uint32_t tree) const;
  void endLeases(Nanoseconds stamp);
  void stepAll(const StepContext& at, Nanoseconds from, Nanoseconds to);
  void choose(const StepContext& at, Nanoseconds from, Nanoseconds to);
  void chooseIn(const StepContext& at, std::uint32_t tree, PhysicalSubtree& part,
                const std::vector<int>& loaded, Nanoseconds stamp);
  std::vector<BranchLoad> expectedLoads(std::uint32_t tree, const PhysicalSubtree& part) const;
  void step(const StepContext& at, Nanoseconds from, Nanoseconds to, std::size_t k, std::size_t n);
  bool isNear(std::uint32_t tree) const;
  void stepTouching(const StepContext& at, std::uint32_t tree, PhysicalSubtree& part,
                    Nanoseconds from, Nanoseconds to);
  void stepAmong(const StepContext& at, const ContactModel::Wood& wood, PhysicalSubtree& part,
                 Nanoseconds from, Nanoseconds to, Nanoseconds whole, SubstepBisection& bisection);
  void addTouches(const std::vector<Reaction>& reactions);
  void reactToBodies(std::size_t steps);
  void decay(const std::vector<Reaction>& published, double duration);
  void gather(std::uint32_t tree, const Vec3& foot, Nanoseconds from, Nanoseconds to);
  void addPushes(std::uint32_t tree, Nanoseconds from, Nanoseconds to);
  void accumulateLoads(const StepContext& at, std::uint32_t tree, const PhysicalSubtree& part,
                       Nanoseconds from, Nanoseconds to);
  void settle(const StepContext& at, Nanoseconds from, Nanoseconds to);
  void react(std::uint32_t tree, const PhysicalSubtree& part, double duration);
  bool isLoaded(std::uint32_t tree) const;

  PhysicsSettings settings_;
  std::map<std::uint32_t, Grab> grabs_;
  std::map<std::uint32_t, Hold> holds_;
  std::vector<Push> pushes_;
  Bodies bodies_;
  std::map<std::uint32_t, PhysicalSubtree> parts_;
  std::map<std::uint32_t, Touches> touches_;
  std::map<std::uint32_t, std::vector<BranchLoad>> contact_loads_;  // of the last tick
  std::vector<Grab> ended_;
  std::vector<Reaction> reactions_;
  std::uint32_t next_grab_{1};
  Nanoseconds next_review_{0};
  std::size_t steps_{0}, skipped_{0}, coarse_{0};
  std::map<std::uint32_t, std::size_t> refused_;  // branches that loaded trees want: no room
  std::vector<std::uint32_t> near_;  // trees that bodies may touch in this tick, rising
  std::vector<Reaction> touching_;   // of bodies in this tick: sums over its steps
  SubtreeLoads loads_;               // scratch
  SubtreeScratch scratch_;           // dropped with the last part
};

}  // namespace vegetation_sim::forest
