// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/physical/physical_subtree.h"

#include <algorithm>
#include <cmath>

#include "dynamics/chain/inertia_bound.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

JointAngles anglesOf(const physics::Vec2& a) {
  return {a.x(), a.y()};
}

}  // namespace

PhysicalSubtree::PhysicalSubtree(std::shared_ptr<const Tree> tree, const Species& species,
                                 Material material)
    : tree_(std::move(tree)),
      species_(species),
      wood_(woodOf(tree_->skeleton, species, material)),
      mask_(tree_->skeleton.branches.size(), 0) {}

int PhysicalSubtree::linkOf(int branch) const {
  const auto found = std::lower_bound(branches_.begin(), branches_.end(), branch);
  if (found == branches_.end() || *found != branch) return -1;
  return static_cast<int>(found - branches_.begin());
}

bool PhysicalSubtree::holds(int branch) const {
  const int link = linkOf(branch);
  return link >= 0 && joints_[index(link)].blend == NEVER;
}

std::size_t PhysicalSubtree::blending() const {
  return static_cast<std::size_t>(std::count_if(
      joints_.begin(), joints_.end(), [](const SubtreeJoint& j) { return j.blend != NEVER; }));
}

PromotedTree PhysicalSubtree::promoted(Nanoseconds stamp, double duration) const {
  PromotedTree out{stamp, duration, {}};
  out.branches.reserve(joints_.size());
  const physics::ChainState& state = state_.get();
  for (std::size_t i = 0; i < joints_.size(); ++i)
    out.branches.push_back(
        {joints_[i].branch, anglesOf(state.q[i]), anglesOf(state.rate[i]), joints_[i].blend});
  return out;
}

void PhysicalSubtree::setMaterial(Material material) {
  wood_ = woodOf(tree_->skeleton, species_, material);
  std::vector<Joined> all;
  const physics::ChainState& state = state_.get();
  for (std::size_t i = 0; i < joints_.size(); ++i)
    all.push_back({joints_[i], state.q[i], state.rate[i]});
  rebuild(all);
}

void PhysicalSubtree::breakOff(std::shared_ptr<const Tree> tree, Material material) {
  tree_ = std::move(tree);
  wood_ = woodOf(tree_->skeleton, species_, material);
  std::vector<Joined> left;
  const physics::ChainState& state = state_.get();
  for (std::size_t i = 0; i < joints_.size(); ++i)
    if (!tree_->skeleton.branches[index(joints_[i].branch)].broken)
      left.push_back({joints_[i], state.q[i], state.rate[i]});
  rebuild(left);
}

double PhysicalSubtree::stressOf(std::size_t link) const {
  const physics::Vec2& q = state_.get().q[link];
  const double torque = links_[link].stiffness * std::sqrt(q.x() * q.x() + q.y() * q.y());
  const double radius = tree_->skeleton.branches[index(branches_[link])].base_radius;
  return 4.0 * torque / (PI * radius * radius * radius);
}

// Rebuilds all arrays for these joints, sorted by branch, without spare capacity.
void PhysicalSubtree::rebuild(const std::vector<Joined>& joints) {
  const std::size_t n = joints.size();
  mask_.assign(mask_.size(), 0);
  joints_.clear();
  branches_.clear();
  state_.setChain(nullptr);
  physics::ChainState& state = state_.change();
  state = physics::ChainState();
  joints_.reserve(n);
  branches_.reserve(n);
  state.q.reserve(n);
  state.rate.reserve(n);
  for (const Joined& joined : joints) {
    mask_[index(joined.joint.branch)] = 1;
    joints_.push_back(joined.joint);
    branches_.push_back(joined.joint.branch);
    state.q.push_back(joined.q);
    state.rate.push_back(joined.rate);
  }
  findLastPromoted();
  findCarriers();
  std::vector<Composite> clusters;
  const bool whole = n == mask_.size();
  if (!whole) clusterWood(tree_->skeleton, wood_.own, mask_, clusters);
  links_.clear();
  drags_.clear();
  links_.reserve(n);
  drags_.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Composite& body = (whole ? wood_.own : clusters)[index(branches_[i])];
    links_.push_back(linkFor(i, body));
    const Vec3 centre = body.drag > 0.0 ? Vec3(body.drag_moment / body.drag) : Vec3(Vec3::Zero());
    drags_.push_back({body.drag, centre});
  }
  physics::shareInertia(links_);
}

void PhysicalSubtree::findLastPromoted() {
  last_promoted_ = NEVER;
  for (const SubtreeJoint& joint : joints_)
    if (last_promoted_ == NEVER || joint.promoted > last_promoted_) last_promoted_ = joint.promoted;
}

void PhysicalSubtree::findCarriers() {
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

physics::Link PhysicalSubtree::linkFor(std::size_t link, const Composite& body) const {
  const std::size_t i = index(branches_[link]);
  const Branch& b = tree_->skeleton.branches[i];
  physics::Link out;
  out.parent = b.parent < 0 ? -1 : linkOf(b.parent);
  if (out.parent < 0 && b.parent >= 0)
    out.base = 1 + static_cast<int>(std::lower_bound(carriers_.begin(), carriers_.end(), b.parent) -
                                    carriers_.begin());
  out.h = b.h;
  out.rest = b.turn;
  out.length = b.length;
  out.mass = body.mass;
  out.centre = body.moment / body.mass;
  out.inertia = {body.inertia[0], body.inertia[1], body.inertia[2],
                 body.inertia[3], body.inertia[4], body.inertia[5]};
  out.stiffness = wood_.stiffness[i];
  out.damping = wood_.damping[i];
  return out;
}

Nanoseconds PhysicalSubtree::lastNeeded() const {
  Nanoseconds out = 0;
  for (const SubtreeJoint& joint : joints_) out = std::max({out, joint.needed, joint.promoted});
  return out;
}

std::size_t PhysicalSubtree::bytes() const {
  const std::size_t n = mask_.capacity();
  return sizeof(*this) + n + (state_.chain() ? state_.chain()->bytes() : 0) +
         joints_.capacity() * (sizeof(SubtreeJoint) + sizeof(int) + 2 * sizeof(physics::Vec2)) +
         links_.capacity() * (sizeof(physics::Link) + sizeof(LinkDrag)) +
         carriers_.capacity() * sizeof(int) +
         wood_.own.capacity() * (2 * sizeof(Composite) + 3 * sizeof(double)) +
         tree_->skeleton.branches.capacity() * (sizeof(Branch) + sizeof(Response));
}

void PhysicalSubtree::addTo(Hash& hash) const {
  hash.add(theta_);
  const physics::ChainState& state = state_.get();
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const SubtreeJoint& joint = joints_[i];
    hash.add(static_cast<std::uint64_t>(joint.branch));
    for (const Nanoseconds stamp : {joint.promoted, joint.needed, joint.blend})
      hash.add(static_cast<std::uint64_t>(stamp));
    hash.add(joint.compensation);
    hash.add(static_cast<std::uint64_t>(joint.wanted));
    for (const physics::Vec2& v : {state.q[i], state.rate[i]}) hash.add(v.x()), hash.add(v.y());
  }
}

}  // namespace vegetation_sim::forest
