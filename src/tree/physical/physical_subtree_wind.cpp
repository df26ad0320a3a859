// Wind on the physical part of a tree, and the compensation after promotion.
#include <algorithm>
#include <cmath>

#include "tree/physical/physical_subtree.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

// Without prediction, drag takes at most half of a link's speed in a step, however light the link
// is.
constexpr double STRONGEST_DRAG = 0.5 * PHYSICS_RATE;  // [1/s]

// Returns true if steps predict drag. Contacts always step implicitly, and so do explicit methods
// beyond their bounds.
bool predictsDrag(const PhysicsSettings& settings) {
  return settings.dynamics == physics::Dynamics::ARTICULATED &&
         physics::isImplicit(settings.integrator);
}

}  // namespace

// Adds the drag of each link with the wood that it carries, at its present position and velocity.
void PhysicalSubtree::addWind(const WindWindow& wind, const physics::Kinematics& kinematics,
                              const PhysicsSettings& settings, SubtreeScratch& scratch,
                              physics::Loads& loads) const {
  const std::size_t n = links_.size();
  scratch.air.clear();
  scratch.arms.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Pose& pose = kinematics.pose[i];
    scratch.arms[i] = rotate(pose.orientation, drags_[i].centre);
    scratch.air.add(tree_->foot + pose.position + scratch.arms[i]);
  }
  scratch.air.sample(wind.now());
  const bool predicted = predictsDrag(settings);
  if (predicted) loads.drag.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const LinkDrag& drag = drags_[i];
    if (drag.force <= 0.0) continue;
    const Vec3& arm = scratch.arms[i];
    const Vec3 own = kinematics.velocity[i] + cross(kinematics.spin[i], arm);
    const double share =
        predicted ? 1.0 : std::min(1.0, STRONGEST_DRAG * links_[i].mass / drag.force);
    const Vec3 relative = scratch.air.velocity(i) - share * own;
    const Vec3 force =
        drag.force * effectiveVelocity(relative, tree_->drag, tree_->reference_speed);
    loads.wrench[i].force += force;
    loads.wrench[i].torque += cross(arm, force);
    if (predicted) loads.drag[i] = dragAt(drag.force, relative, arm);
  }
}

// Returns the derivative of the drag force.
physics::Drag PhysicalSubtree::dragAt(double force, const Vec3& wind, const Vec3& arm) const {
  if (tree_->drag == Drag::LINEAR) return {arm, force, Vec3::Zero()};
  const double speed = length(wind), slope = force / tree_->reference_speed;
  if (speed == 0.0) return {arm, 0.0, Vec3::Zero()};
  return {arm, slope * speed, std::sqrt(slope / speed) * wind};
}

double PhysicalSubtree::compensationAt(std::size_t link, Nanoseconds stamp, double fade) const {
  const SubtreeJoint& joint = joints_[link];
  if (fade <= 0.0) return 0.0;
  const double progress = secondsBetween(joint.promoted, stamp) / fade;
  return joint.compensation * (1.0 - smootherStep(progress));
}

bool PhysicalSubtree::compensates(Nanoseconds stamp, double fade) const {
  // The share of the joint that was promoted last is the last to become zero.
  if (fade <= 0.0 || secondsBetween(last_promoted_, stamp) / fade >= 1.0) return false;
  for (std::size_t i = 0; i < joints_.size(); ++i)
    if (compensationAt(i, stamp, fade) > 0.0) return true;
  return false;
}

// Adds the joint torques that turn the real load into that of the procedural motion: inverse
// dynamics of this motion under the real load (E1), times the fading share. `paper`: without spring
// and damper torques, as printed (S1-26).
void PhysicalSubtree::addCompensation(const TreeWind& air, Nanoseconds stamp,
                                      const PhysicsSettings& settings, SubtreeScratch& s,
                                      physics::Loads& loads) const {
  // The dynamics of paper 1 have no inverse here: their branches meet the real load at once.
  if (settings.dynamics != physics::Dynamics::ARTICULATED || !compensates(stamp, settings.fade))
    return;
  const std::size_t n = links_.size();
  s.procedural.q.resize(n);
  s.procedural.rate.resize(n);
  s.acceleration.resize(n);
  const ProceduralMotion motion = s.motionOf(*tree_, air, stamp);
  s.motions.update(motion, branches_);
  for (std::size_t i = 0; i < n; ++i) {
    const JointMotion at = s.motions.at(i);
    s.procedural.q[i] = {at.q.first, at.q.second};
    s.procedural.rate[i] = {at.rate.first, at.rate.second};
    s.acceleration[i] = {at.acceleration.first, at.acceleration.second};
  }
  physics::kinematicsOf(links_, s.bases, s.procedural, s.kinematics);
  s.loads.clear(n);
  addWind(motion.wind, s.kinematics, settings, s, s.loads);
  s.body.torques(links_, s.bases, s.procedural, s.kinematics, s.loads, s.acceleration, s.torque);
  const bool printed = settings.wind_forcing == WindForcing::PAPER;
  for (std::size_t i = 0; i < n; ++i) {
    const double share = compensationAt(i, stamp, settings.fade);
    physics::Vec2 torque = s.torque[i];
    if (printed)
      torque -= links_[i].stiffness * s.procedural.q[i] + links_[i].damping * s.procedural.rate[i];
    loads.joint_torque[i] += share * torque;
  }
}

}  // namespace vegetation_sim::forest
