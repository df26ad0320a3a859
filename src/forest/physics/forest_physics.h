// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/threads/thread_pool.h"
#include "forest/contact/contact_finder.h"
#include "forest/contact/substep_bisection.h"
#include "tree/physical/interaction.h"
#include "tree/physical/physical_subtree.h"
#include "vegetation_sim/forest/physics/modal_forest.h"
#include "vegetation_sim/terrain/height_map.h"
#include "vegetation_sim/tree/state/level_map.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::forest {

/// The surroundings of a physics step. ForestPhysics keeps none of it.
struct StepContext {
  const Layout& layout;
  std::uint64_t layout_hash;
  const terrain::HeightMap& terrain;
  const wind::Field& wind;
  const LevelMap& levels;
  const ModalForest& modes;
  const ContactFinder& contacts;
  const TreeGrid& grid;
  ThreadPool& threads;
  const TreeOwners& owners;  ///< trees of other shards have no physics here
  bool reviews_by_tree;      ///< see Forest
  Nanoseconds stamp;         ///< of the last tick

  TreeWind windOf(std::uint32_t tree) const {
    return {wind, levels.of(tree), layout.motion, modes.find(tree)};
  }
};
struct TickContext;
class TreeSteps;
class TreePieces;

/// A grab in force and its state between ticks.
struct HeldGrab : Grab {
  Vec3 last_target{Vec3::Zero()};      ///< at the last tick, world [m]
  bool renewed_since_tick{true};       ///< moved or renewed since the last tick
  double max_target_distance{0.0};     ///< from the tree's foot [m]
  Vec3 foot{Vec3::Zero()};             ///< of the tree, world [m]
  Vec3 force{Vec3::Zero()};            ///< on the branch, mean over the last tick [N]
  Vec3 grip{Vec3::Zero()};             ///< position of the held point, tree's frame [m]
  Vec3 impulse{Vec3::Zero()};          ///< on the branch since the last tick [N s]
  Vec3 last_direction{Vec3::UnitZ()};  ///< jawDirection at the last tick
  Vec3 axis{Vec3::UnitZ()};            ///< of the branch at the held point, if there is a jaw
  Vec3 torque{Vec3::Zero()};           ///< on the branch about the held point, as `force` [N m]
  Vec3 angular_impulse{Vec3::Zero()};  ///< as `impulse` [N m s]
  bool limited{false};                 ///< the force was at its limit since the last tick
};
using HeldGrabs = std::map<std::uint32_t, HeldGrab>;

/// A branch that came off in a tick.
struct Break {
  std::uint32_t tree{0};
  BrokenBranch piece;
  double stress{0.0};                ///< bending stress at its joint; 0: not physical [Pa]
  double mass{0.0};                  ///< of the piece, with its leaves [kg]
  std::vector<std::uint32_t> grabs;  ///< ids of the grabs that ended with it
};

/// Number of branches of trees that are grown to cut branches in one tick, about 20 ms; one tree
/// may exceed it.
constexpr std::size_t MOST_CUT_BRANCHES = 65536;

/// Checks a request against a layout and the tree that it names. All throw InvalidInput.
void checkGrab(const Layout& layout, const Tree& tree, const Grab& grab);
void checkTarget(const Tree& tree, const Vec3& target);
void checkPush(const Layout& layout, const Tree& tree, const Push& push);
void checkCut(const Layout& layout, const Tree& tree, const BranchCut& cut);

/// Grabs, pushes and bodies that act on the trees of a forest, and the physical parts of these
/// trees. A value: a copy is a snapshot. Requests act from the last tick on; invalid ones, and
/// those for trees of another shard, throw InvalidInput and change nothing.
class ForestPhysics {
 public:
  std::uint32_t addGrab(const StepContext& context, const Grab& grab);
  /// @param holder world pose of the grab's frame.
  void moveGrab(std::uint32_t id, const Vec3& target, const Pose& holder);
  void renewGrab(std::uint32_t id);
  void release(std::uint32_t id);
  void push(const StepContext& context, const Push& push);
  /// Cuts a branch off at the end of the next tick, or of a later one if many are cut at once: a
  /// tick grows about MOST_CUT_BRANCHES branches of trees for them, tree after tree in the order of
  /// the requests. What the branch carries goes with it, and grabs of it end.
  void cut(const StepContext& context, const BranchCut& cut);
  void setBody(const Body& body);
  void removeBody(const std::string& id);
  void setSettings(const PhysicsSettings& settings, Nanoseconds now);
  /// @throws InvalidInput if a branch that `what` loads could not be physical now.
  void checkRoom(const std::string& what, std::uint32_t tree, int branch) const;
  /// @throws InvalidInput if not all branches of a tree could be physical now.
  void checkRoomForTree(const std::string& what, const Tree& tree, std::uint32_t id) const;
  /// Removes grabs, pushes, bodies and all physical subtrees, and makes broken trees whole; keeps
  /// the settings.
  void clear();

  /// Steps from the last tick to `to` in ceil(PHYSICS_RATE * time) equal steps.
  void advance(const StepContext& context, Nanoseconds to);

  const PhysicsSettings& settings() const { return settings_; }
  const HeldGrabs& grabs() const { return grabs_; }
  const Bodies& bodies() const { return bodies_; }
  /// Grabs that ended at the last tick by their lease or with their branch.
  const std::vector<EndedGrab>& ended() const { return ended_; }
  /// Returns the branches that have come off the trees, and those that did so at the last tick.
  const BrokenTrees& broken() const { return broken_; }
  const std::vector<Break>& breaks() const { return breaks_; }
  const std::vector<Reaction>& reactions() const { return reactions_; }
  const std::map<std::uint32_t, PhysicalSubtree>& subtrees() const { return subtrees_; }
  /// Returns the joints before the last tick of each tree in which branches have become physical,
  /// or have stopped blending back, since.
  const std::map<std::uint32_t, PromotedTree>& beforePromotions() const { return before_; }
  /// Physical joints of a tree at the last tick; `branches` is empty if there are none.
  PromotedTree promoted(std::uint32_t tree, Nanoseconds last_tick) const;
  /// Pose of every branch in the tree's frame, physical joints and modes included.
  std::vector<Pose> pose(const StepContext& context, const Tree& tree, std::uint32_t id,
                         Nanoseconds stamp) const;
  PhysicsFigures figures() const;
  std::size_t branchCount() const;  ///< of physical branches
  /// Number of trees grown so far to check and make cuts.
  std::uint64_t grownToCut() const { return grown_to_cut_; }
  void addTo(Hash& hash) const;
  /// Adds what acts on each tree, and its physical joints.
  void addTo(TreeHashes& hashes) const;
  /// Returns a grown tree of the layout.
  using GrowTree = std::function<std::shared_ptr<const Tree>(std::uint32_t tree)>;
  /// Writes or reads everything. @throws InvalidInput for a state that does not fit the layout.
  /// Requires that archiveBroken() has read the broken branches, because modes depend on them.
  void archive(Archive& a, const Layout& layout, const GrowTree& grow);
  void archiveBroken(Archive& a, const Layout& layout);

 private:
  void archiveSubtrees(Archive& a, const Layout& layout, const GrowTree& grow);
  void archiveContacts(Archive& a, const Layout& layout);
  void checkRead(const Layout& layout, const GrowTree& grow) const;
  PhysicalSubtree& findOrAddSubtree(const StepContext& context, std::uint32_t tree);
  bool isPulledHarder(std::uint32_t tree) const;
  void appendWholeTree(const StepContext& context, std::uint32_t tree, std::vector<int>& loaded);
  void requestReview(const StepContext& context, std::uint32_t tree);
  void beginReviews(const StepContext& context, Nanoseconds start);
  void endLeases(Nanoseconds stamp);
  void stepAll(const StepContext& context, Nanoseconds to);
  void promoteLoaded(const StepContext& context, Nanoseconds from, Nanoseconds to);
  void promoteInTree(const StepContext& context, std::uint32_t tree, PhysicalSubtree& subtree,
                     const std::vector<int>& loaded, Nanoseconds stamp);
  std::vector<BranchLoad> predictLoads(std::uint32_t tree, const PhysicalSubtree& subtree) const;
  bool isNear(std::uint32_t tree) const;
  void stepTrees(const TickContext& tick);
  void publishContactReactions(const std::vector<TreeSteps>& trees);
  void decayReactions(const std::vector<Reaction>& published, double duration);
  void finishTick(Nanoseconds to);
  bool isLoaded(std::uint32_t tree) const;
  Tree grow(const StepContext& context, std::uint32_t tree) const;
  std::shared_ptr<const Tree> growToCut(const StepContext& context, std::uint32_t tree);
  void forgetGrown();
  void cutBranches(const StepContext& context, Nanoseconds to);
  std::size_t cutTree(const StepContext& context, std::uint32_t tree, Nanoseconds to,
                      std::size_t most);
  void breakOverloaded(const StepContext& context, Nanoseconds to);
  Break cutOff(const StepContext& context, const BranchCut& cut, const Pose& pose,
               Nanoseconds stamp);
  BrokenBranch pieceOf(const StepContext& context, std::uint32_t tree, std::size_t link,
                       Nanoseconds stamp);
  void takeOff(const StepContext& context, std::uint32_t tree, TreePieces pieces);

  PhysicsSettings settings_;
  HeldGrabs grabs_;
  std::vector<Push> pushes_;
  Bodies bodies_;
  std::map<std::uint32_t, PhysicalSubtree> subtrees_;
  std::map<std::uint32_t, PersistentContacts> persistent_contacts_;
  std::map<std::uint32_t, std::vector<BranchLoad>> contact_loads_;  // of the last tick
  std::vector<EndedGrab> ended_;
  std::vector<BranchCut> cuts_;                                 // at the next ticks
  std::map<std::uint32_t, std::shared_ptr<const Tree>> grown_;  // cache between two ticks, for cuts
  std::size_t grown_branches_{0};                               // of grown_
  std::uint64_t grown_to_cut_{0};
  BrokenTrees broken_;
  std::vector<Break> breaks_;  // of the last tick
  std::size_t unbroken_{0};    // at the last tick
  std::vector<Reaction> reactions_;
  std::map<std::uint32_t, PromotedTree> before_;
  std::uint32_t next_grab_{1};
  Nanoseconds next_review_{0};  // of all trees, unless each has its own
  std::size_t steps_{0}, skipped_{0}, coarse_{0};
  std::map<std::uint32_t, std::size_t> refused_;  // branches that found no room, by tree
  std::vector<std::uint32_t> near_;           // trees that bodies may touch in this tick, rising
  std::vector<SubtreeScratch> scratches_{1};  // of threads; freed with the last subtree
};

}  // namespace vegetation_sim::forest
