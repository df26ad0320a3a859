// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/physical_part.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/common/math.h"

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

JointAngles anglesOf(const physics::Vec2& a) {
  return {a.x(), a.y()};
}

// Rate of smoothStep's weight [1/s].
double blendRate(const PartJoint& joint, Nanoseconds stamp, double duration) {
  const double u = secondsBetween(joint.blend, stamp) / duration;
  return u <= 0.0 || u >= 1.0 ? 0.0 : 6.0 * u * (1.0 - u) / duration;
}

}  // namespace

PhysicalPart::PhysicalPart(std::shared_ptr<const Tree> tree, const Species& species,
                           Material material)
    : tree_(std::move(tree)),
      species_(species),
      wood_(woodOf(tree_->skeleton, species, material)),
      mask_(tree_->skeleton.branches.size(), 0) {}

int PhysicalPart::linkOf(int branch) const {
  const auto found = std::lower_bound(branches_.begin(), branches_.end(), branch);
  if (found == branches_.end() || *found != branch) return -1;
  return static_cast<int>(found - branches_.begin());
}

bool PhysicalPart::holds(int branch) const {
  const int link = linkOf(branch);
  return link >= 0 && joints_[index(link)].blend == NEVER;
}

std::size_t PhysicalPart::blending() const {
  return static_cast<std::size_t>(std::count_if(
      joints_.begin(), joints_.end(), [](const PartJoint& j) { return j.blend != NEVER; }));
}

PromotedTree PhysicalPart::promoted(Nanoseconds stamp, double duration) const {
  PromotedTree out{stamp, duration, {}};
  out.branches.reserve(joints_.size());
  for (std::size_t i = 0; i < joints_.size(); ++i)
    out.branches.push_back(
        {joints_[i].branch, anglesOf(state_.q[i]), anglesOf(state_.rate[i]), joints_[i].blend});
  return out;
}

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
      all.push_back(
          {{added[i], stamp, stamp, NEVER, 1.0, true}, vectorOf(at.q), vectorOf(at.rate)});
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
    joint.compensation = weight;
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
  std::vector<Joined> left;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const PartJoint& joint = joints_[i];
    const bool over = joint.blend != NEVER && secondsBetween(joint.blend, stamp) >= settings.blend;
    if (!over) left.push_back({joint, state_.q[i], state_.rate[i]});
  }
  if (left.size() < joints_.size()) rebuild(left);
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

void PhysicalPart::setMaterial(Material material) {
  wood_ = woodOf(tree_->skeleton, species_, material);
  std::vector<Joined> all;
  for (std::size_t i = 0; i < joints_.size(); ++i)
    all.push_back({joints_[i], state_.q[i], state_.rate[i]});
  rebuild(all);
}

// Lays everything out anew for these joints, by rising branch. Nothing is kept for others.
void PhysicalPart::rebuild(const std::vector<Joined>& joints) {
  const std::size_t n = joints.size();
  mask_.assign(mask_.size(), 0);
  joints_.clear();
  branches_.clear();
  chain_.held.reset();
  state_ = physics::ChainState();
  joints_.reserve(n);
  branches_.reserve(n);
  state_.q.reserve(n);
  state_.rate.reserve(n);
  for (const Joined& joined : joints) {
    mask_[index(joined.joint.branch)] = 1;
    joints_.push_back(joined.joint);
    branches_.push_back(joined.joint.branch);
    state_.q.push_back(joined.q);
    state_.rate.push_back(joined.rate);
  }
  findCarriers();
  std::vector<Composite> clusters;
  clusterWood(tree_->skeleton, wood_, mask_, clusters);
  links_.clear();
  drags_.clear();
  links_.reserve(n);
  drags_.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Composite& body = clusters[index(branches_[i])];
    links_.push_back(linkFor(i, body));
    const Vec3 centre = body.drag > 0.0 ? Vec3(body.drag_moment / body.drag) : Vec3(Vec3::Zero());
    drags_.push_back({body.drag, centre});
  }
}

void PhysicalPart::findCarriers() {
  carriers_.clear();
  const auto& branches = tree_->skeleton.branches;
  for (const int branch : branches_) {
    int parent = branches[index(branch)].parent;
    if (parent >= 0 && mask_[index(parent)]) continue;
    for (; parent >= 0; parent = branches[index(parent)].parent) carriers_.push_back(parent);
  }
  std::sort(carriers_.begin(), carriers_.end());
  carriers_.erase(std::unique(carriers_.begin(), carriers_.end()), carriers_.end());
}

physics::Link PhysicalPart::linkFor(std::size_t link, const Composite& body) const {
  const std::size_t i = index(branches_[link]);
  const Branch& b = tree_->skeleton.branches[i];
  physics::Link out;
  out.parent = b.parent < 0 ? -1 : linkOf(b.parent);
  if (out.parent < 0 && b.parent >= 0)
    out.base = 1 + static_cast<int>(std::lower_bound(carriers_.begin(), carriers_.end(), b.parent) -
                                    carriers_.begin());
  out.h = b.h;
  out.rest = restRotation(b.theta, b.phi);
  out.length = b.length;
  out.mass = body.mass;
  out.centre = body.moment / body.mass;
  out.inertia = {body.inertia[0], body.inertia[1], body.inertia[2],
                 body.inertia[3], body.inertia[4], body.inertia[5]};
  out.stiffness = wood_.stiffness[i];
  out.damping = wood_.damping[i];
  return out;
}

std::size_t PhysicalPart::bytes() const {
  const std::size_t n = mask_.capacity();
  return sizeof(*this) + n + (chain_.held ? chain_.held->bytes() : 0) +
         joints_.capacity() * (sizeof(PartJoint) + sizeof(int) + 2 * sizeof(physics::Vec2)) +
         links_.capacity() * (sizeof(physics::Link) + sizeof(Drag)) +
         carriers_.capacity() * sizeof(int) +
         wood_.own.capacity() * (2 * sizeof(Composite) + 3 * sizeof(double)) +
         tree_->skeleton.branches.capacity() * (sizeof(Branch) + sizeof(Response));
}

void PhysicalPart::addTo(Hash& hash) const {
  hash.add(theta_);
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const PartJoint& joint = joints_[i];
    hash.add(static_cast<std::uint64_t>(joint.branch));
    for (const Nanoseconds stamp : {joint.promoted, joint.needed, joint.blend})
      hash.add(static_cast<std::uint64_t>(stamp));
    hash.add(joint.compensation);
    hash.add(static_cast<std::uint64_t>(joint.wanted));
    for (const physics::Vec2& v : {state_.q[i], state_.rate[i]}) hash.add(v.x()), hash.add(v.y());
  }
}

}  // namespace vegetation_sim::forest
