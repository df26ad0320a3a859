// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/physics/forest_physics.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::forest {
namespace {

/// Interval of the choice of physical branches.
constexpr Nanoseconds REVIEW = NANOSECONDS_PER_SECOND / 10;
/// Steps that use the wind of one stamp: 60 Hz.
constexpr std::size_t AIR_STEPS = 4;
/// Physical branches stay so down to this fraction of the tolerance (hysteresis).
constexpr double KEEP = 0.5;

// Steps are equal in whole nanoseconds, so no rounding accumulates.
std::size_t stepsBetween(Nanoseconds from, Nanoseconds to) {
  const Nanoseconds gap = to - from;
  return static_cast<std::size_t>((gap * PHYSICS_RATE + NANOSECONDS_PER_SECOND - 1) /
                                  NANOSECONDS_PER_SECOND);
}

Vec3 pointOn(const Pose& pose, double along) {
  return pose.position + along * axisZ(pose.orientation);
}

}  // namespace

void ForestPhysics::advance(const StepContext& context, Nanoseconds to) {
  ended_.clear();
  const std::vector<Reaction> published = std::move(reactions_);
  reactions_.clear();
  steps_ = 0;
  scratch_.replaced = 0;
  scratch_.window = WindWindow();  // the wind may have changed
  endLeases(to);
  if (!subtrees_.empty() || !grabs_.empty() || !pushes_.empty() || !bodies_.empty())
    stepAll(context, to);
  else
    context.contacts.releaseTrees();
  decayReactions(published, secondsBetween(context.stamp, to));
}

void ForestPhysics::stepAll(const StepContext& context, Nanoseconds to) {
  const Nanoseconds from = context.stamp;
  const bool gap = to <= from || to - from > LONGEST_GAP;
  if (gap && !subtrees_.empty()) ++skipped_;
  const Nanoseconds start = gap ? to : from;
  promoteLoaded(context, start, to);
  const std::size_t steps = subtrees_.empty() ? 0 : stepsBetween(start, to);
  for (std::size_t k = 0; k < steps; ++k) step(context, start, to, k, steps);
  steps_ = steps;
  finishTick(context, start, to);
}

void ForestPhysics::endLeases(Nanoseconds stamp) {
  for (auto it = grabs_.begin(); it != grabs_.end();) {
    HeldGrab& grab = it->second;
    if (grab.renewed_since_tick) grab.renewed = stamp;
    grab.renewed_since_tick = false;
    const bool over = grab.lease > 0.0 && secondsBetween(grab.renewed, stamp) > grab.lease;
    if (!over) {
      ++it;
      continue;
    }
    ended_.push_back(grab);
    it = grabs_.erase(it);
  }
}

void ForestPhysics::promoteLoaded(const StepContext& context, Nanoseconds from, Nanoseconds to) {
  BranchesOfTrees loaded;
  const auto pose_tree = [&](const Tree& tree, std::uint32_t id, Nanoseconds stamp) {
    return pose(context, tree, id, stamp);
  };
  context.contacts.findNear({context.layout, context.layout_hash, context.terrain, pose_tree},
                            bodies_, from, to, loaded);
  near_.clear();
  for (const auto& entry : loaded) near_.push_back(entry.first);
  for (auto it = persistent_contacts_.begin(); it != persistent_contacts_.end();)
    it = isNear(it->first) ? std::next(it) : persistent_contacts_.erase(it);
  for (const auto& entry : grabs_) {
    const BranchPoint& point = entry.second.point;
    loaded[point.tree].push_back(point.branch);
  }
  for (const Push& push : pushes_)
    if (push.from < to && push.until > from) loaded[push.point.tree].push_back(push.point.branch);
  const bool review = from >= next_review_;
  if (review) next_review_ = from + REVIEW;
  for (auto& [tree, subtree] : subtrees_)
    if (!loaded.count(tree)) subtree.releaseJoints();
  for (auto it = refused_.begin(); it != refused_.end();)
    it = loaded.count(it->first) ? std::next(it) : refused_.erase(it);
  for (const auto& [tree, branches] : loaded) {
    PhysicalSubtree& subtree = findOrAddSubtree(context, tree);
    bool missing = false;
    for (const int branch : branches) missing = missing || !subtree.holds(branch);
    if (review || missing) promoteInTree(context, tree, subtree, branches, from);
  }
}

// Makes the branches physical that the loads of a tree need.
void ForestPhysics::promoteInTree(const StepContext& context, std::uint32_t tree,
                                  PhysicalSubtree& subtree, const std::vector<int>& loaded,
                                  Nanoseconds stamp) {
  const Skeleton& skeleton = subtree.tree().skeleton;
  const bool by_depth = settings_.promotion == Promotion::DEPTH;
  std::vector<double> score;
  if (by_depth)
    score = scoreByDepth(skeleton, loaded);
  else
    score = predictDeflection(skeleton, subtree.wood(), predictLoads(tree, subtree));
  for (const int branch : loaded) score[static_cast<std::size_t>(branch)] = LOADED;
  std::vector<double> rank = score;  // physical branches rank before others
  for (const SubtreeJoint& joint : subtree.joints()) {
    double& held = rank[static_cast<std::size_t>(joint.branch)];
    held = std::max(held, LOADED * (1.0 - 0.5 / (1.0 + held)));
  }
  std::size_t others = 0;
  for (const auto& [id, other] : subtrees_)
    if (id != tree) others += other.joints().size();
  const auto most = static_cast<std::size_t>(settings_.most_branches);
  const double threshold = by_depth ? 0.0 : settings_.influence_tolerance;
  const Selection selection = selectBranches(skeleton, rank, threshold, KEEP * threshold,
                                             subtree.mask(), most > others ? most - others : 0);
  for (const SubtreeJoint& joint :
       subtree.joints())  // beyond the cap: makes room for loaded branches
    if (!std::binary_search(selection.branches.begin(), selection.branches.end(), joint.branch))
      score[static_cast<std::size_t>(joint.branch)] = 0.0;
  const ProceduralMotion motion = scratch_.motionOf(subtree.tree(), windOf(context, tree), stamp);
  refused_[tree] = selection.refused +
                   subtree.promote(selection.branches, score, KEEP * threshold, motion, settings_);
}

// Returns the present loads of a tree, or those that springs will have when they have reached their
// targets.
std::vector<BranchLoad> ForestPhysics::predictLoads(std::uint32_t tree,
                                                    const PhysicalSubtree& subtree) const {
  std::vector<BranchLoad> out;
  for (const auto& [id, grab] : grabs_) {
    if (grab.point.tree != tree) continue;
    const Branch& b = subtree.tree().skeleton.branches[static_cast<std::size_t>(grab.point.branch)];
    const Vec3 way = grab.target - subtree.tree().foot - pointOn(b.rest, grab.point.along);
    const double distance = length(way);
    Vec3 force = grab.force;
    if (distance > 1e-9) {
      const Vec3 direction = way / distance;
      const double give = compliance(subtree.tree().skeleton, subtree.wood(), grab.point.branch,
                                     grab.point.along, direction);
      const double pull = std::min(grab.force_limit, distance / (1.0 / grab.stiffness + give));
      if (pull > length(force)) force = pull * direction;
    }
    out.push_back({grab.point.branch, grab.point.along, force});
  }
  for (const Push& push : pushes_)
    if (push.point.tree == tree) out.push_back({push.point.branch, push.point.along, push.force});
  const auto touches = contact_loads_.find(tree);
  if (touches != contact_loads_.end())
    out.insert(out.end(), touches->second.begin(), touches->second.end());
  return out;
}

// Step number k of n between two ticks.
void ForestPhysics::step(const StepContext& context, Nanoseconds from, Nanoseconds to,
                         std::size_t k, std::size_t n) {
  const auto stamp_of = [&](std::size_t i) {
    return from + (to - from) * static_cast<Nanoseconds>(i) / static_cast<Nanoseconds>(n);
  };
  for (auto& [tree, subtree] : subtrees_) {
    if (subtree.empty()) continue;
    collectSprings(tree, subtree.tree().foot, from, to);
    addPushes(tree, stamp_of(k), stamp_of(k + 1));
    if (k == 0) accumulateImpulses(context, tree, subtree, from, from);
    loads_.air = NEVER;
    loads_.hold = false;
    if (isNear(tree)) {
      stepNearBodies(context, tree, subtree, stamp_of(k), stamp_of(k + 1));
      continue;
    }
    const std::size_t first = k - k % AIR_STEPS, last = std::min(first + AIR_STEPS, n);
    loads_.air = (stamp_of(first) + stamp_of(last)) / 2;
    loads_.hold = k != first;
    subtree.step(windOf(context, tree), loads_, settings_, stamp_of(k), stamp_of(k + 1), scratch_);
    accumulateImpulses(context, tree, subtree, stamp_of(k), stamp_of(k + 1));
  }
}

// Collects the springs on a tree. Targets move in a straight line between ticks.
void ForestPhysics::collectSprings(std::uint32_t tree, const Vec3& foot, Nanoseconds from,
                                   Nanoseconds to) {
  loads_.springs.clear();
  loads_.forces.clear();
  const double seconds = secondsBetween(from, to);
  for (const auto& [id, grab] : grabs_) {
    if (grab.point.tree != tree) continue;
    Vec3 velocity = Vec3::Zero();
    if (seconds > 0.0) velocity = (grab.target - grab.last_target) / seconds;
    loads_.springs.push_back({grab.point, grab.target - foot, velocity, to, grab.stiffness,
                              grab.damping, grab.force_limit});
  }
}

// Adds forces on a tree as means over a step, so that each push has its whole impulse.
void ForestPhysics::addPushes(std::uint32_t tree, Nanoseconds from, Nanoseconds to) {
  for (const Push& push : pushes_) {
    const Nanoseconds begin = std::max(push.from, from), end = std::min(push.until, to);
    if (push.point.tree != tree || end <= begin) continue;
    const double share = secondsBetween(begin, end) / secondsBetween(from, to);
    loads_.forces.push_back({push.point.branch, push.point.along, share * push.force});
  }
}

// Publishes reactions and demotes branches after the last step.
void ForestPhysics::finishTick(const StepContext& context, Nanoseconds from, Nanoseconds to) {
  publishContactReactions();
  for (auto& [tree, subtree] : subtrees_) {
    if (to <= from) {
      collectSprings(tree, subtree.tree().foot, from, to);
      accumulateImpulses(context, tree, subtree, to, to);
    }
    publishGrabReactions(tree, subtree, secondsBetween(from, to));
    subtree.demote(scratch_.motionOf(subtree.tree(), windOf(context, tree), to), settings_,
                   scratch_);
  }
  for (auto& [id, grab] : grabs_) grab.last_target = grab.target;
  pushes_.erase(std::remove_if(pushes_.begin(), pushes_.end(),
                               [&](const Push& push) { return push.until <= to; }),
                pushes_.end());
  for (auto it = subtrees_.begin(); it != subtrees_.end();)
    it = it->second.empty() && !isLoaded(it->first) ? subtrees_.erase(it) : std::next(it);
  if (!subtrees_.empty()) return;
  scratch_ = SubtreeScratch();
  loads_ = SubtreeLoads();
}

bool ForestPhysics::isLoaded(std::uint32_t tree) const {
  if (isNear(tree)) return true;
  for (const auto& entry : grabs_)
    if (entry.second.point.tree == tree) return true;
  return std::any_of(pushes_.begin(), pushes_.end(),
                     [&](const Push& push) { return push.point.tree == tree; });
}

// Adds the impulse of the grabs on a tree between two stamps: springs by the positions at both,
// dampers by the displacement. Equal stamps begin a tick.
void ForestPhysics::accumulateImpulses(const StepContext& context, std::uint32_t tree,
                                       const PhysicalSubtree& subtree, Nanoseconds from,
                                       Nanoseconds to) {
  if (loads_.springs.empty()) return;
  subtree.placesAt(loads_.springs, windOf(context, tree), to, scratch_, scratch_.places);
  const double h = secondsBetween(from, to);
  std::size_t index = 0;
  for (auto& [id, grab] : grabs_) {
    if (grab.point.tree != tree) continue;
    const SubtreeSpring& spring = loads_.springs[index];
    const Vec3 before = grab.grip;
    grab.grip = scratch_.places[index++];
    if (subtree.linkOf(grab.point.branch) < 0) continue;
    if (h <= 0.0) {
      const SpringForce now = forceOf(spring, to, grab.grip, spring.velocity);
      grab.force = now.force;
      grab.impulse = Vec3::Zero();
      grab.limited = now.scale < 1.0;
      continue;
    }
    const SpringForce mean = forceOf(spring, from + (to - from) / 2, 0.5 * (before + grab.grip),
                                     (grab.grip - before) / h);
    grab.impulse += h * mean.force;
    grab.limited = grab.limited || mean.scale < 1.0;
  }
}

// Publishes the reactions of the springs on a tree: means over the tick, with their whole impulse;
// after a gap in time, the present forces.
void ForestPhysics::publishGrabReactions(std::uint32_t tree, const PhysicalSubtree& subtree,
                                         double duration) {
  for (auto& [id, grab] : grabs_) {
    if (grab.point.tree != tree || subtree.linkOf(grab.point.branch) < 0) continue;
    if (duration > 0.0) grab.force = grab.impulse / duration;
    Reaction out;
    out.grab = id;
    out.frame = grab.frame;
    out.holder = grab.holder;
    out.at = grab.point;
    out.point = subtree.tree().foot + grab.grip;
    out.force = -grab.force;
    out.limited = grab.limited;
    reactions_.push_back(out);
  }
}

TreeWind ForestPhysics::windOf(const StepContext& context, std::uint32_t tree) const {
  return {context.wind, context.levels.of(tree), context.layout.motion, context.modes.find(tree)};
}

PromotedTree ForestPhysics::promoted(std::uint32_t tree, Nanoseconds last_tick) const {
  const auto found = subtrees_.find(tree);
  if (found == subtrees_.end()) return {last_tick, settings_.blend, {}};
  return found->second.promoted(last_tick, settings_.blend);
}

std::vector<Pose> ForestPhysics::pose(const StepContext& context, const Tree& tree,
                                      std::uint32_t id, Nanoseconds stamp) const {
  const Weights weights = weightsAt(context.levels.of(id), stamp, context.layout.motion);
  return poseBranches(tree, context.wind.at(stamp).relativeTo(tree.foot), weights,
                      context.modes.find(id), promoted(id, context.stamp), stamp);
}

}  // namespace vegetation_sim::forest
