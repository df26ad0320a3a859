// Promotion.
#include <algorithm>

#include "tree/physical/physical_subtree.h"

namespace vegetation_sim::forest {
namespace {

// Returns the rate of smoothStep's weight [1/s].
double blendRate(const SubtreeJoint& joint, Nanoseconds stamp, double duration) {
  const double u = secondsBetween(joint.blend, stamp) / duration;
  return u <= 0.0 || u >= 1.0 ? 0.0 : 6.0 * u * (1.0 - u) / duration;
}

}  // namespace

// Merges old and new joints; new ones start on the procedural motion (S1-36).
std::size_t PhysicalSubtree::promote(const std::vector<int>& branches,
                                     const std::vector<double>& score, double keep,
                                     const ProceduralMotion& motion,
                                     const PhysicsSettings& settings) {
  const Nanoseconds stamp = motion.wind.stamp();
  std::vector<Joined> all;
  all.reserve(joints_.size() + branches.size());
  for (std::size_t i = 0; i < joints_.size(); ++i)
    all.push_back({joints_[i], state_.get().q[i], state_.get().rate[i]});
  std::vector<char> mask = mask_;
  std::vector<int> added;
  std::size_t refused = 0;
  for (const int branch : branches) {  // sorted: parents come first
    if (mask[index(branch)]) continue;
    if (leavesGap(mask, branch)) {
      ++refused;
      continue;
    }
    mask[index(branch)] = 1;
    added.push_back(branch);
  }
  if (!added.empty()) {
    ProceduralMotions motions;
    motions.update(motion, added);
    for (std::size_t i = 0; i < added.size(); ++i) {
      const JointMotion at = motions.at(i);
      all.push_back(
          {{added[i], stamp, stamp, NEVER, 1.0, true}, vectorOf(at.q), vectorOf(at.rate)});
    }
    std::sort(all.begin(), all.end(),
              [](const Joined& a, const Joined& b) { return a.joint.branch < b.joint.branch; });
    rebuild(all);
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    joints_[i].wanted = score[index(joints_[i].branch)] > keep;
    if (joints_[i].wanted) cancelBlend(static_cast<int>(i), motion, settings.blend);
  }
  return refused;
}

void PhysicalSubtree::releaseJoints() {
  for (SubtreeJoint& joint : joints_) joint.wanted = false;
}

// Returns true if an ancestor of the branch is physical, but not its parent.
bool PhysicalSubtree::leavesGap(const std::vector<char>& mask, int branch) const {
  const auto& branches = tree_->skeleton.branches;
  int parent = branches[index(branch)].parent;
  if (parent < 0 || mask[index(parent)]) return false;
  for (; parent >= 0; parent = branches[index(parent)].parent)
    if (mask[index(parent)]) return true;
  return false;
}

// Cancels the blend of a branch and its ancestors from the visible motion, without a jump in angle
// or rate (S1-38).
void PhysicalSubtree::cancelBlend(int link, const ProceduralMotion& motion, double duration) {
  const Nanoseconds stamp = motion.wind.stamp();
  for (; link >= 0; link = links_[index(link)].parent) {
    SubtreeJoint& joint = joints_[index(link)];
    if (joint.blend == NEVER) continue;
    joint.needed = stamp;
    const double weight = blendWeight({joint.branch, {}, {}, joint.blend}, stamp, duration);
    const double change = blendRate(joint, stamp, duration);
    const JointMotion to = motion.at(joint.branch);
    physics::ChainState& state = state_.change();
    physics::Vec2 &q = state.q[index(link)], &rate = state.rate[index(link)];
    const physics::Vec2 away = vectorOf(to.q) - q;
    rate = (1.0 - weight) * rate + weight * vectorOf(to.rate) + change * away;
    q += weight * away;
    joint.blend = NEVER;
    joint.promoted = stamp;
    last_promoted_ = std::max(last_promoted_, stamp);
    joint.compensation = weight;
  }
}

void PhysicalSubtree::stretchBlends(Nanoseconds stamp, double from, double to) {
  for (SubtreeJoint& joint : joints_)
    if (joint.blend != NEVER)
      joint.blend = stamp - fromSeconds(secondsBetween(joint.blend, stamp) * to / from);
}

}  // namespace vegetation_sim::forest
