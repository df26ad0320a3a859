// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// From procedural to physical and back.
#include <algorithm>
#include <cmath>

#include "tree/physical/physical_subtree.h"

namespace vegetation_sim::forest {
namespace {

/// A motion is calm if it would carry nothing farther than the tolerance within this time [s].
constexpr double CALM_TIME = 0.1;

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

double magnitude(const physics::Vec2& a) {
  return std::sqrt(a.x() * a.x() + a.y() * a.y());
}

physics::Vec2 vectorOf(const JointAngles& a) {
  return {a.first, a.second};
}

// Rate of smoothStep's weight [1/s].
double blendRate(const PartJoint& joint, Nanoseconds stamp, double duration) {
  const double u = secondsBetween(joint.blend, stamp) / duration;
  return u <= 0.0 || u >= 1.0 ? 0.0 : 6.0 * u * (1.0 - u) / duration;
}

}  // namespace

// Joins what is physical already and what shall be; new joints start on the procedural motion
// (S1-36).
std::size_t PhysicalPart::promote(const std::vector<int>& branches,
                                  const std::vector<double>& score, double keep,
                                  const Course& course, const PhysicsSettings& settings) {
  const Nanoseconds stamp = course.wind.stamp();
  std::vector<Joined> all;
  all.reserve(joints_.size() + branches.size());
  for (std::size_t i = 0; i < joints_.size(); ++i)
    all.push_back({joints_[i], state_.q[i], state_.rate[i]});
  std::vector<char> mask = mask_;
  std::vector<int> added;
  std::size_t refused = 0;
  for (const int branch : branches) {  // rising: bearers come first
    if (mask[index(branch)]) continue;
    if (wouldGap(mask, branch)) {
      ++refused;
      continue;
    }
    mask[index(branch)] = 1;
    added.push_back(branch);
  }
  if (!added.empty()) {
    Courses courses;
    courses.look(course, added);
    for (std::size_t i = 0; i < added.size(); ++i) {
      const JointCourse at = courses.at(i);
      all.push_back({{added[i], stamp, stamp, NEVER, course.missing(), true},
                     vectorOf(at.q),
                     vectorOf(at.rate)});
    }
    std::sort(all.begin(), all.end(),
              [](const Joined& a, const Joined& b) { return a.joint.branch < b.joint.branch; });
    rebuild(all);
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    joints_[i].wanted = score[index(joints_[i].branch)] > keep;
    if (joints_[i].wanted) takeBack(static_cast<int>(i), course, settings.blend);
  }
  return refused;
}

void PhysicalPart::letGo() {
  for (PartJoint& joint : joints_) joint.wanted = false;
}

// True if a bearer of the branch is physical, but not the one right below it.
bool PhysicalPart::wouldGap(const std::vector<char>& mask, int branch) const {
  const auto& branches = tree_->skeleton.branches;
  int parent = branches[index(branch)].parent;
  if (parent < 0 || mask[index(parent)]) return false;
  for (; parent >= 0; parent = branches[index(parent)].parent)
    if (mask[index(parent)]) return true;
  return false;
}

// A branch in the middle of its blend goes on from where it is seen, and so does all that bears it:
// no jump in angle or rate (S1-38).
void PhysicalPart::takeBack(int link, const Course& course, double duration) {
  const Nanoseconds stamp = course.wind.stamp();
  for (; link >= 0; link = links_[index(link)].parent) {
    PartJoint& joint = joints_[index(link)];
    if (joint.blend == NEVER) continue;
    joint.needed = stamp;
    const double weight = blendWeight({joint.branch, {}, {}, joint.blend}, stamp, duration);
    const double change = blendRate(joint, stamp, duration);
    const JointCourse to = course.at(joint.branch);
    physics::Vec2 &q = state_.q[index(link)], &rate = state_.rate[index(link)];
    const physics::Vec2 away = vectorOf(to.q) - q;
    rate = (1.0 - weight) * rate + weight * vectorOf(to.rate) + change * away;
    q += weight * away;
    joint.blend = NEVER;
    joint.promoted = stamp;
    joint.compensation = weight * course.missing();
  }
}

void PhysicalPart::demote(const Course& course, const PhysicsSettings& settings,
                          PartScratch& scratch) {
  const Nanoseconds stamp = course.wind.stamp();
  bool waiting = false;  // for the calm
  for (PartJoint& joint : joints_) {
    if (joint.wanted) joint.needed = stamp;
    waiting = waiting || (!joint.wanted && joint.blend == NEVER);
  }
  if (waiting) scratch.courses.look(course, branches_);
  std::vector<char> bears(joints_.size(), 0);  // what is physical for good
  for (std::size_t i = joints_.size(); i-- > 0;) {
    PartJoint& joint = joints_[i];
    if (joint.blend == NEVER && !bears[i] && mayGo(i, stamp, scratch.courses, settings))
      joint.blend = stamp;
    if ((joint.blend == NEVER || bears[i]) && links_[i].parent >= 0)
      bears[index(links_[i].parent)] = 1;
  }
  const auto over = [&](const PartJoint& joint) {
    return joint.blend != NEVER && secondsBetween(joint.blend, stamp) >= settings.blend;
  };
  if (std::none_of(joints_.begin(), joints_.end(), over)) return;
  std::vector<Joined> left;
  for (std::size_t i = 0; i < joints_.size(); ++i)
    if (!over(joints_[i])) left.push_back({joints_[i], state_.q[i], state_.rate[i]});
  rebuild(left);
}

// Nothing needs it, and it moves as it would procedurally, or has had its time.
bool PhysicalPart::mayGo(std::size_t link, Nanoseconds stamp, const Courses& courses,
                         const PhysicsSettings& settings) const {
  const PartJoint& joint = joints_[link];
  if (joint.wanted) return false;
  if (secondsBetween(joint.needed, stamp) >= settings.linger) return true;
  const JointCourse at = courses.at(link);
  const double off = magnitude(state_.q[link] - vectorOf(at.q));
  const double speed = magnitude(state_.rate[link] - vectorOf(at.rate));
  const double reach = wood_.reach[index(joint.branch)];
  return (off + CALM_TIME * speed) * reach < settings.influence_tolerance;
}

void PhysicalPart::stretchBlends(Nanoseconds stamp, double from, double to) {
  for (PartJoint& joint : joints_)
    if (joint.blend != NEVER)
      joint.blend = stamp - fromSeconds(secondsBetween(joint.blend, stamp) * to / from);
}

}  // namespace vegetation_sim::forest
