// Loads on the physical part of a tree, and where its links are.
#include <algorithm>

#include "dynamics/chain/bend.h"
#include "tree/physical/physical_subtree.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

physics::Symmetric3 uniform(double value) {
  return {value, value, value, 0.0, 0.0, 0.0};
}

void addForce(const Vec3& force, const Vec3& arm, physics::Wrench& wrench) {
  wrench.force += force;
  wrench.torque += cross(arm, force);
}

}  // namespace

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
