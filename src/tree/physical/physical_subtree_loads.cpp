// Loads on the physical part of a tree, and its step.
#include <algorithm>
#include <cmath>

#include "dynamics/chain/bend.h"
#include "tree/physical/physical_subtree.h"
#include "vegetation_sim/core/math/math.h"
#include "wind/sampling/batch_wind.h"

namespace vegetation_sim::forest {
namespace {

// Chains limit the bends of their joints up to rounding.
constexpr double BEND_ROUNDING = 1.0 + 1e-6;

// Velocity products are predicted instead of averaged where no joint turns farther in a step [rad].
constexpr double PREDICTED_TURN = 0.01;

physics::Symmetric3 uniform(double value) {
  return {value, value, value, 0.0, 0.0, 0.0};
}

void addForce(const Vec3& force, const Vec3& arm, physics::Wrench& wrench) {
  wrench.force += force;
  wrench.torque += cross(arm, force);
}

}  // namespace

/// Callbacks of the stepper during one step.
struct PhysicalSubtree::Step {
  const PhysicalSubtree& part;
  const TreeWind& air;
  const SubtreeLoads& loads;
  const PhysicsSettings& settings;
  SubtreeScratch& scratch;
  Nanoseconds from;
  mutable Nanoseconds based{NEVER};  // stamp of scratch.bases

  Nanoseconds stampAt(double time) const { return from + fromSeconds(time); }
  void updateBases(Nanoseconds stamp) const {
    if (based == stamp) return;
    part.baseMotions(air, stamp, scratch, scratch.bases);
    based = stamp;
  }
  void bases(double time, std::vector<physics::BaseMotion>& out) const {
    updateBases(stampAt(time));
    out = scratch.bases;
  }
  void load(const physics::Kinematics& kinematics, double time, physics::Loads& out) const {
    out.clear(part.links_.size());
    part.addWind(scratch.sampleAt(air.field, stampAt(time)), kinematics, settings, scratch, out);
    addOthers(stampAt(time), kinematics, out);
  }
  // Fills the wind rows of a chain.
  void fillWindRows(double h, const float* places, float* rows, std::size_t blocks) const {
    const bool own = loads.air == NEVER || part.compensates(from, settings.fade);
    const Nanoseconds stamp = own ? stampAt(part.theta_ * h) : loads.air;
    const wind::Instant& now = scratch.sampleAt(air.field, stamp).now();
    fillWind(FloatWind(now.relativeTo(part.tree().foot), LARGEST_TREE), places, rows, blocks);
  }
  // Adds all loads but the wind.
  void addOthers(Nanoseconds stamp, const physics::Kinematics& kinematics,
                 physics::Loads& out) const {
    updateBases(stamp);
    part.addCompensation(air, stamp, settings, scratch, out);
    part.addSprings(loads, stamp, kinematics, out);
    part.addForces(loads, kinematics, out);
  }
  physics::Surroundings outside() const {
    physics::Surroundings out;
    out.bases = [this](double time, std::vector<physics::BaseMotion>& to) { bases(time, to); };
    out.loads = [this](const physics::Kinematics& kinematics, double time, physics::Loads& to) {
      load(kinematics, time, to);
    };
    return out;
  }
  // Surroundings of a chain that has the wind in its own rows.
  physics::Surroundings outsideWind() const {
    physics::Surroundings out;
    if (!part.carriers_.empty())
      out.bases = [this](double time, std::vector<physics::BaseMotion>& to) { bases(time, to); };
    if (loads.springs.empty() && loads.forces.empty() && !part.compensates(from, settings.fade))
      return out;
    out.loads = [this](const physics::Kinematics& kinematics, double time, physics::Loads& to) {
      addOthers(stampAt(time), kinematics, to);
    };
    return out;
  }
};

void PhysicalSubtree::step(const TreeWind& air, const SubtreeLoads& loads,
                           const PhysicsSettings& settings, Nanoseconds from, Nanoseconds to,
                           SubtreeScratch& scratch) {
  const Step context{*this, air, loads, settings, scratch, from};
  const double h = secondsBetween(from, to);
  if (settings.precision == Precision::SINGLE &&
      settings.dynamics == physics::Dynamics::ARTICULATED &&
      settings.integrator == physics::Integrator::MIDPOINT)
    return stepBatched(context, h);
  const physics::Surroundings outside = context.outside();
  scratch.stepper.setDynamics(settings.dynamics);
  physics::ChainState& state = state_.change();
  if (scratch.stepper.step(settings.integrator, links_, outside, 0.0, h, state, theta_) == 0) {
    ++scratch.replaced;  // beyond the bound of the explicit method
    scratch.stepper.step(physics::Integrator::MIDPOINT, links_, outside, 0.0, h, state, theta_);
  }
  limitJoints();
}

// The state stays in the chain. Only rows that follow from the state are there besides, except for
// those that steps of one tick share, so that a copy without chain continues with the same bits.
void PhysicalSubtree::stepBatched(const Step& context, double h) {
  if (!state_.chain()) createChain();
  physics::BatchChain& chain = state_.loadChain(theta_);
  chain.setScratch(context.scratch.chain);
  // Compensation needs the wind of each step.
  if (!context.loads.hold || compensates(context.from, context.settings.fade))
    chain.queryWind([&](const float* places, float* rows, std::size_t blocks) {
      context.fillWindRows(h, places, rows, blocks);
    });
  if (!compensates(context.from, context.settings.fade))
    chain.setLoadedLinks(&listLoaded(context.loads, context.scratch));
  const bool predicts = context.loads.hold && h * chain.fastest(0) <= PREDICTED_TURN;
  chain.step(context.outsideWind(), 0.0, h, predicts ? 1 : 0);
  state_.followChain();
  theta_ = chain.theta(0);
  if (chain.isWithin(BEND_ROUNDING * LARGEST_BEND, FASTEST_BEND)) return;
  limitJoints();
  context.scratch.chain.clear();  // values that are not finite would reach other trees
}

void PhysicalSubtree::createChain() {
  auto chain = std::make_unique<physics::BatchChain>(links_);
  const bool linear = tree_->drag == Drag::LINEAR;
  std::vector<physics::Grip> grips;
  for (const LinkDrag& drag : drags_)
    grips.push_back({drag.centre, linear ? drag.force : 0.0,
                     linear ? 0.0 : drag.force / tree_->reference_speed});
  chain->setGrips(0, grips);
  state_.setChain(std::move(chain));
}

// Keeps angles and rates within the limits of chains and messages: the printed dynamics oscillate
// without bound (E2), and a grab may bend a twig beyond any limit.
void PhysicalSubtree::limitJoints() {
  physics::ChainState& state = state_.change();
  for (std::size_t i = 0; i < links_.size(); ++i) {
    physics::Vec2 &q = state.q[i], &rate = state.rate[i];
    const double bend = std::sqrt(q.x() * q.x() + q.y() * q.y());
    const double speed = std::sqrt(rate.x() * rate.x() + rate.y() * rate.y());
    if (bend <= BEND_ROUNDING * LARGEST_BEND && speed <= FASTEST_BEND) continue;  // false for NaN
    const bool finite = std::isfinite(bend) && std::isfinite(speed);
    if (!finite || bend > LARGEST_BEND) rate = {0.0, 0.0};
    if (!finite) q = {0.0, 0.0};
    if (finite && bend > LARGEST_BEND) q *= LARGEST_BEND / bend;
    if (finite && bend <= LARGEST_BEND) rate *= FASTEST_BEND / speed;
  }
}

void PhysicalSubtree::stepWithContacts(const TreeWind& air, const SubtreeLoads& loads,
                                       const PhysicsSettings& settings, Nanoseconds from,
                                       Nanoseconds to, SubtreeScratch& scratch,
                                       std::vector<physics::Contact>& contacts) {
  const Step context{*this, air, loads, settings, scratch, from};
  const double h = secondsBetween(from, to);
  physics::ChainState& state = state_.change();
  theta_ = physics::guardedTheta(state, h, theta_);
  const bool euler = settings.integrator == physics::Integrator::IMPLICIT_EULER;
  scratch.contact_stepper.step(links_, context.outside(), settings.contact, 0.0, h,
                               euler ? 1.0 : theta_, state, contacts);
  limitJoints();
}

void PhysicalSubtree::kinematicsAt(const TreeWind& air, Nanoseconds stamp, SubtreeScratch& scratch,
                                   physics::Kinematics& out) const {
  baseMotions(air, stamp, scratch, scratch.bases);
  physics::kinematicsOf(links_, scratch.bases, state_.get(), out);
}

void PhysicalSubtree::placesAt(const std::vector<SubtreeSpring>& springs, const TreeWind& air,
                               Nanoseconds stamp, SubtreeScratch& scratch,
                               std::vector<Vec3>& out) const {
  baseMotions(air, stamp, scratch, scratch.bases);
  out.resize(springs.size());
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const int link = linkOf(springs[i].point.branch);
    if (link < 0) continue;
    const Pose pose = poseOf(link, scratch.bases);
    out[i] = pose.position + springs[i].point.along * axisZ(pose.orientation);
  }
}

// Computes the pose of one link as physics::kinematicsOf does for all.
Pose PhysicalSubtree::poseOf(int link, const std::vector<physics::BaseMotion>& bases) const {
  const physics::Link& own = links_[index(link)];
  const Pose from = own.parent < 0 ? bases[index(own.base)].pose : poseOf(own.parent, bases);
  const physics::Vec2 q = state_.bend(index(link));
  return {from.position + own.h * axisZ(from.orientation),
          from.orientation * (own.rest * physics::rotationOf(physics::bendOf(q), q))};
}

// Base 0 is the ground; the carriers follow.
void PhysicalSubtree::baseMotions(const TreeWind& air, Nanoseconds stamp, SubtreeScratch& scratch,
                                  std::vector<physics::BaseMotion>& out) const {
  out.resize(1 + carriers_.size());
  out[0] = physics::BaseMotion();
  if (carriers_.empty()) return;
  scratch.carrier_motions.update(scratch.motionOf(*tree_, air, stamp), carriers_);
  moveCarriers(*tree_, carriers_, scratch.carrier_motions, scratch.carrier_poses, scratch.carriers);
  for (std::size_t i = 0; i < carriers_.size(); ++i) {
    const CarrierMotion& motion = scratch.carriers[i];
    out[i + 1] = {motion.pose, motion.spin, motion.velocity, motion.spin_rate, motion.acceleration};
  }
}

SpringForce forceOf(const SubtreeSpring& spring, Nanoseconds stamp, const Vec3& point,
                    const Vec3& velocity) {
  const Vec3 target = spring.target + secondsBetween(spring.stamp, stamp) * spring.velocity;
  SpringForce out;
  out.force = spring.stiffness * (target - point) + spring.damping * (spring.velocity - velocity);
  const double size = length(out.force);
  if (size > spring.force_limit) out.scale = spring.force_limit / size;
  out.force *= out.scale;
  return out;
}

// At its limit a spring acts as a softer one with the same force, so that an implicit step cannot
// overshoot, however light the branch.
void PhysicalSubtree::addSprings(const SubtreeLoads& loads, Nanoseconds stamp,
                                 const physics::Kinematics& kinematics, physics::Loads& out) const {
  for (const SubtreeSpring& spring : loads.springs) {
    const int link = linkOf(spring.point.branch);
    if (link < 0) continue;
    const Pose& pose = kinematics.pose[index(link)];
    const Vec3 arm = spring.point.along * axisZ(pose.orientation);
    const Vec3 velocity =
        kinematics.velocity[index(link)] + cross(kinematics.spin[index(link)], arm);
    const SpringForce f = forceOf(spring, stamp, pose.position + arm, velocity);
    out.anchors.push_back({link, arm, f.force, uniform(f.scale * spring.stiffness),
                           uniform(f.scale * spring.damping)});
  }
}

// Lists the links that springs and forces act on.
const std::vector<std::size_t>& PhysicalSubtree::listLoaded(const SubtreeLoads& loads,
                                                            SubtreeScratch& scratch) const {
  std::vector<std::size_t>& out = scratch.loaded;
  out.clear();
  const auto add = [&](int branch) {
    const int link = linkOf(branch);
    if (link >= 0) out.push_back(index(link));
  };
  for (const SubtreeSpring& spring : loads.springs) add(spring.point.branch);
  for (const BranchLoad& load : loads.forces) add(load.branch);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

void PhysicalSubtree::addForces(const SubtreeLoads& loads, const physics::Kinematics& kinematics,
                                physics::Loads& out) const {
  for (const BranchLoad& load : loads.forces) {
    const int link = linkOf(load.branch);
    if (link < 0) continue;
    const Vec3 arm = load.along * axisZ(kinematics.pose[index(link)].orientation);
    addForce(load.force, arm, out.wrench[index(link)]);
  }
}

}  // namespace vegetation_sim::forest
