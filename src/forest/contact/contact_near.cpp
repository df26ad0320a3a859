// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "forest/contact/contact_body.h"
#include "forest/contact/contact_finder.h"
#include "forest/forest.h"
#include "forest/pick.h"

namespace vegetation_sim::forest {
namespace {

constexpr double LARGEST_TILED = 1.3;  // scale of trees in tiles, seedInTile

// A ball that holds a body during a tick, and what may come to it.
struct Ball {
  Vec3 centre;
  double radius;
};

Ball ballOf(const Body& body, Nanoseconds from, Nanoseconds to) {
  const Vec3 first = poseAt(body, from).position, last = poseAt(body, to).position;
  const double way = length(last - first);
  return {0.5 * (first + last), shapeOf(body).reach() + NEAR + 1.5 * way};
}

bool holds(const Ball& ball, const Branch& branch, const Pose& pose, const Vec3& foot) {
  const Vec3 offset = ball.centre - foot - pose.position, axis = axisZ(pose.orientation);
  const double along = std::clamp(dot(offset, axis), 0.0, branch.length);
  return length(offset - along * axis) <= ball.radius + branch.base_radius;
}

// True if a tree may reach into the ball: a cylinder, and room for its bends.
bool mayReach(const Skeleton& skeleton, const Vec3& foot, const Ball& ball) {
  const double room = skeleton.height + ball.radius;
  const Vec3 offset = ball.centre - foot;
  const double across = std::sqrt(offset.x() * offset.x() + offset.y() * offset.y());
  return across <= skeleton.reach + 0.3 * skeleton.height + ball.radius &&
         std::fabs(offset.z()) <= room;
}

// With all that bears it: the way to the ground carries the lever arm of the contact.
void addWithBearers(const Skeleton& skeleton, int branch, std::vector<char>& chosen) {
  for (int i = branch; i >= 0 && !chosen[static_cast<std::size_t>(i)];
       i = skeleton.branches[static_cast<std::size_t>(i)].parent)
    chosen[static_cast<std::size_t>(i)] = 1;
}

bool within(const Vec3& foot, const Vec3& centre, double distance) {
  return length(foot - centre) <= distance;
}

}  // namespace

std::vector<std::uint32_t> treesNear(const Layout& layout, const terrain::HeightMap& terrain,
                                     const Vec3& centre, double radius) {
  std::vector<double> size;
  double largest = 0.0;
  for (const Species& species : layout.species) size.push_back(sizeBound(species));
  for (const double s : size) largest = std::max(largest, LARGEST_TILED * s);
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < layout.trees.size(); ++i) {
    const TreeSeed& seed = layout.trees[i];
    if (within(footOf(seed, terrain), centre, seed.scale * size[seed.species] + radius))
      out.push_back(i);
  }
  for (const Tile& tile : layout.tiles) {
    const double room = largest + radius;
    if (centre.x() < tile.x - room || centre.x() > tile.x + tile.size + room ||
        centre.y() < tile.y - room || centre.y() > tile.y + tile.size + room)
      continue;
    for (const std::uint32_t i : treesInTile(tile, centre, room)) {
      const TreeSeed seed = seedInTile(tile, i);
      if (within(footOf(seed, terrain), centre, seed.scale * size[seed.species] + radius))
        out.push_back(tile.first_tree + i);
    }
  }
  return out;
}

void ContactFinder::findNear(const Forest& forest, const Bodies& bodies, Nanoseconds from,
                             Nanoseconds to, BranchesOfTrees& near) const {
  // Joints as printed have no physical motion.
  if (static_cast<JointModel>(forest.layout().motion.joint_model) != JointModel::SWING)
    return releaseTrees();
  std::map<std::uint32_t, std::vector<Ball>> balls;
  for (const auto& entry : bodies) {
    const Ball ball = ballOf(entry.second, from, to);
    for (const std::uint32_t tree :
         treesNear(forest.layout(), forest.terrain(), ball.centre, ball.radius))
      balls[tree].push_back(ball);
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  if (layout_hash_ != forest.layoutHash()) trees_.clear();
  layout_hash_ = forest.layoutHash();
  for (auto it = trees_.begin(); it != trees_.end();)
    it = balls.count(it->first) ? std::next(it) : trees_.erase(it);
  for (const auto& [id, around] : balls) {
    std::shared_ptr<const Tree>& grown = trees_[id];
    if (!grown)
      grown = std::make_shared<const Tree>(growTree(forest.layout(), id, forest.terrain()));
    const Tree& tree = *grown;
    const auto reached = [&](const Ball& b) { return mayReach(tree.skeleton, tree.foot, b); };
    if (std::none_of(around.begin(), around.end(), reached)) continue;
    const std::vector<Pose> poses = forest.pose(tree, id, from);
    std::vector<char> chosen(poses.size(), 0);
    for (std::size_t i = 0; i < poses.size(); ++i)
      for (const Ball& ball : around)
        if (holds(ball, tree.skeleton.branches[i], poses[i], tree.foot))
          addWithBearers(tree.skeleton, static_cast<int>(i), chosen);
    std::vector<int>& branches = near[id];
    for (std::size_t i = 0; i < chosen.size(); ++i)
      if (chosen[i]) branches.push_back(static_cast<int>(i));
    if (branches.empty()) near.erase(id);
  }
}

void ContactFinder::releaseTrees() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  trees_.clear();
}

std::size_t ContactFinder::bytes() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::size_t out = 0;
  for (const auto& entry : trees_) {
    const Tree& tree = *entry.second;
    out += sizeof(Trees::value_type) + sizeof(Tree) +
           tree.skeleton.branches.capacity() * sizeof(Branch) +
           tree.skeleton.groups.capacity() * sizeof(Group) +
           tree.response.capacity() * sizeof(Response);
  }
  return out;
}

}  // namespace vegetation_sim::forest
