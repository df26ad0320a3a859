// Demotion.
#include <algorithm>
#include <cmath>

#include "tree/physical/physical_subtree.h"
#include "wind/sampling/batch_wind.h"

namespace vegetation_sim::forest {
namespace {

/// A motion is calm if it would carry no point farther than the tolerance in this time [s].
constexpr double CALM_TIME = 0.1;
/// Single precision gives the wind of a breeze around a tree within this share of its bound; it is
/// ten times what was measured.
constexpr double WIND_ROUNDING = 1e-4;

double magnitude(const physics::Vec2& a) {
  return std::sqrt(a.x() * a.x() + a.y() * a.y());
}

double sumOfSizes(const Vec3& v) {
  return std::fabs(v.x()) + std::fabs(v.y()) + std::fabs(v.z());
}

}  // namespace

void PhysicalSubtree::beginTick(Nanoseconds stamp) {
  in_review_ = stamp >= next_review_;
  if (in_review_) next_review_ = stamp + REVIEW;
}

void PhysicalSubtree::demote(const TreeWind& air, Nanoseconds stamp,
                             const PhysicsSettings& settings, SubtreeScratch& scratch) {
  bool waiting = false, blending = false;
  for (SubtreeJoint& joint : joints_) {
    if (joint.wanted) joint.needed = stamp;
    waiting = waiting || isWaiting(joint);
    blending = blending || joint.blend != NEVER;
  }
  if (!(waiting && in_review_) && !blending) return;
  if (waiting && in_review_) startBlends(air, stamp, settings, scratch);
  const auto over = [&](const SubtreeJoint& joint) {
    return joint.blend != NEVER && secondsBetween(joint.blend, stamp) >= settings.blend;
  };
  if (std::none_of(joints_.begin(), joints_.end(), over)) return;
  const physics::ChainState& state = state_.get();
  std::vector<Joined> left;
  for (std::size_t i = 0; i < joints_.size(); ++i)
    if (!over(joints_[i])) left.push_back({joints_[i], state.q[i], state.rate[i]});
  rebuild(left);
}

// A branch blends only when all its physical children do.
void PhysicalSubtree::startBlends(const TreeWind& air, Nanoseconds stamp,
                                  const PhysicsSettings& settings, SubtreeScratch& scratch) {
  findCalm(air, stamp, settings, scratch);
  if (std::find(scratch.calm.begin(), scratch.calm.end(), 1) == scratch.calm.end()) return;
  std::vector<char>& bears = scratch.bears;  // has physical children that do not blend
  bears.assign(joints_.size(), 0);
  for (std::size_t i = joints_.size(); i-- > 0;) {
    SubtreeJoint& joint = joints_[i];
    if (isWaiting(joint) && !bears[i] && scratch.calm[i]) joint.blend = stamp;
    if ((joint.blend == NEVER || bears[i]) && links_[i].parent >= 0)
      bears[index(links_[i].parent)] = 1;
  }
}

// Finds the waiting joints that are close to their procedural motion or have waited long enough.
void PhysicalSubtree::findCalm(const TreeWind& air, Nanoseconds stamp,
                               const PhysicsSettings& settings, SubtreeScratch& scratch) const {
  std::vector<std::size_t>& links = scratch.waiting;
  links.clear();
  scratch.calm.assign(joints_.size(), 0);
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (!isWaiting(joints_[i])) continue;
    if (secondsBetween(joints_[i].needed, stamp) >= settings.linger)
      scratch.calm[i] = 1;
    else
      links.push_back(i);
  }
  if (links.empty()) return;
  const ProceduralMotion motion = scratch.motionOf(*tree_, air, stamp);
  dropFarJoints(motion, settings, scratch);
  scratch.branches.clear();
  for (const std::size_t link : links) scratch.branches.push_back(branches_[link]);
  scratch.motions.update(motion, scratch.branches);
  const physics::ChainState& state = state_.get();
  for (std::size_t k = 0; k < links.size(); ++k) {
    const std::size_t link = links[k];
    const JointMotion at = scratch.motions.at(k);
    const double off = magnitude(state.q[link] - vectorOf(at.q));
    const double speed = magnitude(state.rate[link] - vectorOf(at.rate));
    const double reach = wood_.reach[index(branches_[link])];
    scratch.calm[link] = (off + CALM_TIME * speed) * reach < settings.influence_tolerance;
  }
}

// Removes from scratch.waiting joints that are certainly too far from their procedural angle, by
// single precision with a margin: the exact motion costs as much as the steps of a tick. Applies to
// breezes only, because the error at the edge of other winds has no such bound.
void PhysicalSubtree::dropFarJoints(const ProceduralMotion& motion, const PhysicsSettings& settings,
                                    SubtreeScratch& scratch) const {
  const wind::Instant& now = motion.wind.now();
  const FloatWind wind(now.relativeTo(tree_->foot), LARGEST_TREE);
  if (motion.modalShare(1) > 0.0 || !wind.terms.empty()) return;
  std::vector<std::size_t>& links = scratch.waiting;
  const std::size_t blocks = (links.size() + physics::ROW - 1) / physics::ROW;
  if (scratch.rest.count() < 3 * blocks) {
    scratch.rest.assign(3 * blocks);
    scratch.rest_air.assign(3 * blocks);
  }
  const auto& branches = tree_->skeleton.branches;
  for (std::size_t k = 0; k < links.size(); ++k) {
    const Vec3& place = branches[index(branches_[links[k]])].rest.position;
    float* rows = scratch.rest.of(static_cast<int>(k), 3);
    for (int axis = 0; axis < 3; ++axis)
      rows[axis * physics::ROW] = static_cast<float>(place[axis]);
  }
  fillWind(wind, scratch.rest.at(0), scratch.rest_air.at(0), blocks);
  const Vec3 bound(now.speedBound(tree_->foot, LARGEST_TREE), 0.0, 0.0);
  const double error =
      WIND_ROUNDING * effectiveVelocity(bound, tree_->drag, tree_->reference_speed).x();
  const physics::ChainState& state = state_.get();
  std::size_t left = 0;
  for (std::size_t k = 0; k < links.size(); ++k) {
    const std::size_t link = links[k], branch = index(branches_[link]);
    const float* rows = scratch.rest_air.of(static_cast<int>(k), 3);
    const Vec3 air(rows[0], rows[physics::ROW], rows[2 * physics::ROW]);
    const Response& response = tree_->response[branch];
    const JointAngles at =
        deviation(response, effectiveVelocity(air, tree_->drag, tree_->reference_speed),
                  motion.weights[1][index(branches[branch].depth)], tree_->joint_model);
    const double off = magnitude(state.q[link] - vectorOf(at)),
                 margin = error * (sumOfSizes(response.first) + sumOfSizes(response.second));
    if ((off - margin) * wood_.reach[branch] < settings.influence_tolerance) links[left++] = link;
  }
  links.resize(left);
}

}  // namespace vegetation_sim::forest
