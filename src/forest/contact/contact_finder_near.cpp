// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "forest/contact/contact_finder.h"

namespace vegetation_sim::forest {
namespace {

// Branches within this distance, plus the travel of a tick, become physical [m].
constexpr double PROMOTION_DISTANCE = 0.1;

// A ball that contains a body during a tick, with a margin.
struct Ball {
  Vec3 centre;
  double radius;
};

Ball ballOf(const Body& body, Nanoseconds from, Nanoseconds to) {
  const Vec3 first = poseAt(body, from).position, last = poseAt(body, to).position;
  const double way = length(last - first);
  return {0.5 * (first + last), shapeOf(body).reach() + PROMOTION_DISTANCE + 1.5 * way};
}

bool holds(const Ball& ball, const Branch& branch, const Pose& pose, const Vec3& foot) {
  const Vec3 offset = ball.centre - foot - pose.position;
  const double near = ball.radius + branch.base_radius, far = 1.001 * (near + branch.length);
  if (dot(offset, offset) > far * far) return false;  // most branches are far away
  const Vec3 axis = axisZ(pose.orientation);
  const double along = std::clamp(dot(offset, axis), 0.0, branch.length);
  return length(offset - along * axis) <= near;
}

// Returns true if a tree may reach into the ball, by a cylinder with a margin for its bends.
bool mayReach(const Skeleton& skeleton, const Vec3& foot, const Ball& ball) {
  const double room = skeleton.height + ball.radius;
  const Vec3 offset = ball.centre - foot;
  const double across = std::sqrt(offset.x() * offset.x() + offset.y() * offset.y());
  return across <= skeleton.reach + 0.3 * skeleton.height + ball.radius &&
         std::fabs(offset.z()) <= room;
}

// Returns how far each branch with all that it bears reaches from its base, however joints bend.
std::vector<double> findReaches(const Skeleton& skeleton) {
  std::vector<double> out(skeleton.branches.size());
  for (std::size_t i = out.size(); i-- > 0;) {
    const Branch& branch = skeleton.branches[i];
    out[i] = std::max(out[i], branch.length + branch.base_radius);
    if (branch.parent < 0) continue;
    double& bearer = out[static_cast<std::size_t>(branch.parent)];
    bearer = std::max(bearer, branch.h + out[i]);
  }
  return out;
}

// Adds a branch and its ancestors: all of them carry the load to the ground.
void addWithBearers(const Skeleton& skeleton, int branch, std::vector<char>& chosen) {
  for (int i = branch; i >= 0 && !chosen[static_cast<std::size_t>(i)];
       i = skeleton.branches[static_cast<std::size_t>(i)].parent)
    chosen[static_cast<std::size_t>(i)] = 1;
}

}  // namespace

void ContactFinder::findNear(const ContactScene& scene, const Bodies& bodies, Nanoseconds from,
                             Nanoseconds to, BranchesOfTrees& near) const {
  // Joints as printed have no physical motion.
  if (scene.layout.motion.joint_model != JointModel::SWING) return releaseTrees();
  std::map<std::uint32_t, std::vector<Ball>> balls;
  for (const auto& entry : bodies) {
    const Ball ball = ballOf(entry.second, from, to);
    for (const std::uint32_t tree :
         findTreesNear(scene.layout, scene.grid, scene.terrain, ball.centre, ball.radius))
      if (!scene.owners || scene.owners->owns(tree)) balls[tree].push_back(ball);
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  if (layout_hash_ != scene.layout_hash) trees_.clear();
  layout_hash_ = scene.layout_hash;
  for (auto it = trees_.begin(); it != trees_.end();)
    it = balls.count(it->first) ? std::next(it) : trees_.erase(it);
  for (const auto& [id, around] : balls) {
    const CachedTree& cached = update(scene, id, trees_[id]);
    const Tree& tree = *cached.tree;
    const auto reached = [&](const Ball& b) { return mayReach(tree.skeleton, tree.foot, b); };
    if (std::none_of(around.begin(), around.end(), reached)) continue;
    const auto enters = [&, &around = around](int branch, const Pose& pose) {
      return std::any_of(around.begin(), around.end(), [&](const Ball& ball) {
        const double far = 1.001 * (ball.radius + cached.reach[static_cast<std::size_t>(branch)]);
        const Vec3 offset = ball.centre - tree.foot - pose.position;
        return dot(offset, offset) <= far * far;
      });
    };
    const ReachedPoses poses = scene.pose(tree, id, from, enters);
    std::vector<char> chosen(poses.poses.size(), 0);
    for (std::size_t i = 0; i < chosen.size(); ++i)
      for (const Ball& ball : around)
        if (poses.entered[i] && !tree.skeleton.branches[i].broken &&
            holds(ball, tree.skeleton.branches[i], poses.poses[i], tree.foot))
          addWithBearers(tree.skeleton, static_cast<int>(i), chosen);
    std::vector<int>& branches = near[id];
    for (std::size_t i = 0; i < chosen.size(); ++i)
      if (chosen[i]) branches.push_back(static_cast<int>(i));
    if (branches.empty()) near.erase(id);
  }
}

// Grows a tree if it is not cached, or has lost branches since.
const ContactFinder::CachedTree& ContactFinder::update(const ContactScene& scene, std::uint32_t id,
                                                       CachedTree& cached) {
  static const BrokenTrees NONE;
  const BrokenBranches& broken = brokenOf(scene.broken ? *scene.broken : NONE, id);
  if (!cached.tree || !(cached.broken == broken)) {
    cached = {std::make_shared<const Tree>(growTree(scene.layout, id, scene.terrain, broken)),
              broken,
              {}};
    cached.reach = findReaches(cached.tree->skeleton);
  }
  return cached;
}

void ContactFinder::releaseTrees() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  trees_.clear();
}

std::size_t ContactFinder::bytes() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::size_t out = 0;
  for (const auto& entry : trees_) {
    const Tree& tree = *entry.second.tree;
    out += sizeof(Trees::value_type) + sizeof(Tree) +
           tree.skeleton.branches.capacity() * sizeof(Branch) +
           tree.skeleton.groups.capacity() * sizeof(Group) +
           tree.response.capacity() * sizeof(Response) +
           entry.second.reach.capacity() * sizeof(double);
  }
  return out;
}

}  // namespace vegetation_sim::forest
