// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "tree/physical/influence.h"
#include "tree/physical/interaction.h"
#include "tree/physical/procedural_motion.h"
#include "tree/physical/subtree_scratch.h"
#include "tree/physical/subtree_state.h"
#include "vegetation_sim/tree/state/promoted_branches.h"

namespace vegetation_sim {
class Archive;
}

namespace vegetation_sim::forest {

/// Interval of the choice of physical branches, and of the start of blends back.
constexpr Nanoseconds REVIEW = NANOSECONDS_PER_SECOND / 10;

/// A physical branch.
struct SubtreeJoint {
  int branch{0};
  Nanoseconds promoted{0};   ///< when it became physical
  Nanoseconds needed{0};     ///< when a load last needed it to be
  Nanoseconds blend{NEVER};  ///< start of its blend back
  double compensation{1.0};  ///< share of the procedural load at `promoted`; it fades from then on
  bool wanted{true};         ///< a load needs it now
};

/// A spring that holds a point of a branch; its target moves at a constant velocity.
struct SubtreeSpring {
  BranchPoint point;
  Vec3 target{Vec3::Zero()};    ///< at `stamp`, tree's frame [m]
  Vec3 velocity{Vec3::Zero()};  ///< [m/s]
  Nanoseconds stamp{0};
  double stiffness{0.0}, damping{0.0}, force_limit{0.0};
};

/// Loads on a subtree in a step besides the wind.
struct SubtreeLoads {
  std::vector<SubtreeSpring> springs;
  std::vector<BranchLoad> forces;
  /// Single precision: stamp of the wind that this step and the following ones with `hold` use.
  /// NEVER: each step evaluates its own wind.
  Nanoseconds air{NEVER};
  bool hold{false};  ///< the step uses the wind of the step before
};

/// The physical part of one tree: any set of branches that is connected between each branch and its
/// highest physical ancestor, so that its lowest branches hang on procedural wood or the ground.
/// Physical branches carry their unpromoted sub-trees rigidly (S1-W9); those move procedurally on
/// top (S1-35).
///
/// Promotion matches angles and rates (S1-36). The load is the real one plus, fading, the remainder
/// that keeps the procedural motion (E1). Demotion blends angles (S1-37) and can be cancelled at
/// any time (S1-38). A branch blends only when all its physical children do, so a held point is
/// always where physics has it. docs/forest.md has the derivations.
///
/// A value; copies share the immutable grown tree.
class PhysicalSubtree {
 public:
  PhysicalSubtree(std::shared_ptr<const Tree> tree, const Species& species, Material material);

  const Tree& tree() const { return *tree_; }
  std::shared_ptr<const Tree> sharedTree() const { return tree_; }
  const Wood& wood() const { return wood_; }
  bool empty() const { return joints_.empty(); }
  const std::vector<char>& mask() const { return mask_; }  ///< [branches of the tree] physical
  const std::vector<SubtreeJoint>& joints() const { return joints_; }  ///< [links]
  const std::vector<int>& branches() const { return branches_; }       ///< [links] rising
  const std::vector<physics::Link>& links() const { return links_; }   ///< [links]
  const physics::ChainState& state() const { return state_.get(); }    ///< [links]
  int linkOf(int branch) const;                                        ///< -1 if not physical
  bool holds(int branch) const;  ///< physical and not blending back
  std::size_t blending() const;
  /// Returns the number of physical branches that do not blend back.
  std::size_t holding() const { return joints_.size() - blending(); }
  /// Returns when a load last needed a joint to be physical, or when one was promoted.
  Nanoseconds lastNeeded() const;
  std::size_t bytes() const;
  void addTo(Hash& hash) const;
  /// Writes or reads the joints; all else follows from them. @throws InvalidInput for joints that
  /// the tree does not have.
  void archive(Archive& a);
  PromotedTree promoted(Nanoseconds stamp, double duration) const;

  /// Makes `branches` (sorted) physical and cancels the blends of those whose score [branches of
  /// the tree] is above `keep`. Returns how many were refused because their parent is missing.
  std::size_t promote(const std::vector<int>& branches, const std::vector<double>& score,
                      double keep, const ProceduralMotion& motion, const PhysicsSettings& settings);
  /// Marks all joints as not needed.
  void releaseJoints();
  /// Begins a tick at `stamp`. It is a review if the next one is due; another follows after REVIEW.
  void beginTick(Nanoseconds stamp);
  /// Returns whether the branches that are physical are chosen anew in this tick.
  bool isInReview() const { return in_review_; }
  void setInReview(bool in_review) { in_review_ = in_review; }
  void setNextReview(Nanoseconds stamp) { next_review_ = stamp; }
  /// In a review, starts blends of branches that are not needed and calm, or have waited long
  /// enough. Always ends completed blends.
  void demote(const TreeWind& air, Nanoseconds stamp, const PhysicsSettings& settings,
              SubtreeScratch& scratch);
  /// Changes the duration of blends; running ones continue from their progress.
  void stretchBlends(Nanoseconds stamp, double from, double to);
  void setMaterial(Material material);
  /// Continues with the same tree after it has lost branches, whose joints end.
  void breakOff(std::shared_ptr<const Tree> tree, Material material);
  /// Returns the largest bending stress at the joint of a physical branch [Pa]: that of a solid bar
  /// under the elastic torque k q, sigma = 4 k q / (pi r^3).
  double stressOf(std::size_t link) const;

  /// Takes one step.
  void step(const TreeWind& air, const SubtreeLoads& loads, const PhysicsSettings& settings,
            Nanoseconds from, Nanoseconds to, SubtreeScratch& scratch);
  /// Takes one step with contacts and sets the forces of `contacts`. Always linearly implicit,
  /// because an explicit method cannot hold a contact.
  void stepWithContacts(const TreeWind& air, const SubtreeLoads& loads,
                        const PhysicsSettings& settings, Nanoseconds from, Nanoseconds to,
                        SubtreeScratch& scratch, std::vector<physics::Contact>& contacts);
  /// The state that stepWithContacts changes.
  struct SavedState {
    physics::ChainState state;
    double theta{0.5};
  };
  SavedState saveState() const { return {state_.get(), theta_}; }
  void restoreState(const SavedState& saved) {
    state_.change() = saved.state;
    theta_ = saved.theta;
  }
  /// Computes poses and velocities of the links, tree's frame.
  void kinematicsAt(const TreeWind& air, Nanoseconds stamp, SubtreeScratch& scratch,
                    physics::Kinematics& out) const;
  /// Computes the points that springs hold, tree's frame; undefined for branches that are not
  /// physical.
  void placesAt(const std::vector<SubtreeSpring>& springs, const TreeWind& air, Nanoseconds stamp,
                SubtreeScratch& scratch, std::vector<Vec3>& out) const;

 private:
  struct Joined {
    SubtreeJoint joint;
    physics::Vec2 q, rate;
  };
  struct LinkDrag {
    double force;  // per air speed [kg/s]
    Vec3 centre;   // own axes [m]
  };
  struct Step;
  void stepBatched(const Step& context, double h);
  void createChain();
  bool compensates(Nanoseconds stamp, double fade) const;
  void limitJoints();
  void rebuild(const std::vector<Joined>& joints);
  void findCarriers();
  void findLastPromoted();
  physics::Link linkFor(std::size_t link, const Composite& body) const;
  bool leavesGap(const std::vector<char>& mask, int branch) const;
  void cancelBlend(int link, const ProceduralMotion& motion, double duration);
  static bool isWaiting(const SubtreeJoint& joint) { return !joint.wanted && joint.blend == NEVER; }
  void startBlends(const TreeWind& air, Nanoseconds stamp, const PhysicsSettings& settings,
                   SubtreeScratch& scratch);
  void findCalm(const TreeWind& air, Nanoseconds stamp, const PhysicsSettings& settings,
                SubtreeScratch& scratch) const;
  void dropFarJoints(const ProceduralMotion& motion, const PhysicsSettings& settings,
                     SubtreeScratch& scratch) const;
  double compensationAt(std::size_t link, Nanoseconds stamp, double fade) const;
  void baseMotions(const TreeWind& air, Nanoseconds stamp, SubtreeScratch& scratch,
                   std::vector<physics::BaseMotion>& out) const;
  void addWind(const WindWindow& wind, const physics::Kinematics& kinematics,
               const PhysicsSettings& settings, SubtreeScratch& scratch,
               physics::Loads& loads) const;
  physics::Drag dragAt(double force, const Vec3& wind, const Vec3& arm) const;
  void addCompensation(const TreeWind& air, Nanoseconds stamp, const PhysicsSettings& settings,
                       SubtreeScratch& scratch, physics::Loads& loads) const;
  void addSprings(const SubtreeLoads& loads, Nanoseconds stamp,
                  const physics::Kinematics& kinematics, physics::Loads& out) const;
  void addForces(const SubtreeLoads& loads, const physics::Kinematics& kinematics,
                 physics::Loads& out) const;
  const std::vector<std::size_t>& listLoaded(const SubtreeLoads& loads,
                                             SubtreeScratch& scratch) const;
  Pose poseOf(int link, const std::vector<physics::BaseMotion>& bases) const;

  std::shared_ptr<const Tree> tree_;
  Species species_;
  Wood wood_;
  std::vector<char> mask_;
  std::vector<SubtreeJoint> joints_;
  std::vector<int> branches_;
  std::vector<physics::Link> links_;
  std::vector<LinkDrag> drags_;
  std::vector<int> carriers_;  // unpromoted ancestors of promoted branches, sorted
  SubtreeState state_;         // with the chain of links_
  double theta_{0.5};
  Nanoseconds last_promoted_{NEVER};  // latest of joints_
  Nanoseconds next_review_{0};
  bool in_review_{false};
};

/// Limits of bend [rad] and rate [rad/s] of physical joints.
constexpr double LARGEST_BEND = 3.0, FASTEST_BEND = 1e4;
/// Largest distance of any branch from its tree's foot [m].
constexpr double LARGEST_TREE = 1e3;

/// Force of a spring on its branch at `point` with `velocity`, and the factor that keeps its law
/// within the force limit (1 below it).
struct SpringForce {
  Vec3 force{Vec3::Zero()};
  double scale{1.0};
};
SpringForce forceOf(const SubtreeSpring& spring, Nanoseconds stamp, const Vec3& point,
                    const Vec3& velocity);

}  // namespace vegetation_sim::forest
