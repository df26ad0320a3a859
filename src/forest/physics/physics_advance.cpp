// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/physics/forest_physics.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::forest {
namespace {

/// How often is looked which branches a load needs.
constexpr Nanoseconds REVIEW = NANOSECONDS_PER_SECOND / 10;
/// Steps that the air of one moment serves: 60 Hz.
constexpr std::size_t AIR_STEPS = 4;
/// Branches that are physical stay so down to this share of the tolerance (hysteresis).
constexpr double KEEP = 0.5;

// Equal steps in whole nanoseconds: no rounded time adds up.
std::size_t stepsBetween(Nanoseconds from, Nanoseconds to) {
  const Nanoseconds gap = to - from;
  return static_cast<std::size_t>((gap * PHYSICS_RATE + NANOSECONDS_PER_SECOND - 1) /
                                  NANOSECONDS_PER_SECOND);
}

Vec3 pointOn(const Pose& pose, double along) {
  return pose.position + along * axisZ(pose.orientation);
}

}  // namespace

void ForestPhysics::advance(const StepContext& at, Nanoseconds from, Nanoseconds to) {
  ended_.clear();
  const std::vector<Reaction> published = std::move(reactions_);
  reactions_.clear();
  steps_ = 0;
  scratch_.replaced = 0;
  scratch_.window = WindWindow();  // the wind may be another by now
  endLeases(to);
  if (!parts_.empty() || !grabs_.empty() || !pushes_.empty() || !bodies_.empty())
    stepAll(at, from, to);
  else if (at.contacts)
    at.contacts->releaseTrees();
  decay(published, secondsBetween(from, to));
}

void ForestPhysics::stepAll(const StepContext& at, Nanoseconds from, Nanoseconds to) {
  const bool gap = to <= from || to - from > LONGEST_GAP;
  if (gap && !parts_.empty()) ++skipped_;
  const Nanoseconds start = gap ? to : from;
  choose(at, start, to);
  const std::size_t steps = parts_.empty() ? 0 : stepsBetween(start, to);
  for (std::size_t k = 0; k < steps; ++k) step(at, start, to, k, steps);
  steps_ = steps;
  settle(at, start, to);
}

void ForestPhysics::endLeases(Nanoseconds stamp) {
  for (auto it = grabs_.begin(); it != grabs_.end();) {
    Grab& grab = it->second;
    Hold& hold = holds_[grab.id];
    if (hold.renewed) grab.renewed = stamp;
    hold.renewed = false;
    const bool over = grab.lease > 0.0 && secondsBetween(grab.renewed, stamp) > grab.lease;
    if (!over) {
      ++it;
      continue;
    }
    ended_.push_back(grab);
    holds_.erase(grab.id);
    it = grabs_.erase(it);
  }
}

void ForestPhysics::choose(const StepContext& at, Nanoseconds from, Nanoseconds to) {
  BranchesOfTrees loaded;
  if (at.contacts) at.contacts->findNear(at.forest, bodies_, from, to, loaded);
  near_.clear();
  for (const auto& entry : loaded) near_.push_back(entry.first);
  for (auto it = touches_.begin(); it != touches_.end();)
    it = isNear(it->first) ? std::next(it) : touches_.erase(it);
  for (const auto& entry : grabs_) {
    const BranchPoint& point = entry.second.point;
    loaded[point.tree].push_back(point.branch);
  }
  for (const Push& push : pushes_)
    if (push.from < to && push.until > from) loaded[push.point.tree].push_back(push.point.branch);
  const bool review = from >= next_review_;
  if (review) next_review_ = from + REVIEW;
  for (auto& [tree, part] : parts_)
    if (!loaded.count(tree)) part.releaseTrees();
  for (auto it = refused_.begin(); it != refused_.end();)
    it = loaded.count(it->first) ? std::next(it) : refused_.erase(it);
  for (const auto& [tree, branches] : loaded) {
    PhysicalSubtree& part = partOf(at, tree);
    bool missing = false;
    for (const int branch : branches) missing = missing || !part.holds(branch);
    if (review || missing) chooseIn(at, tree, part, branches, from);
  }
}

// Which branches of a tree its loads need, and that they are physical from now on.
void ForestPhysics::chooseIn(const StepContext& at, std::uint32_t tree, PhysicalSubtree& part,
                             const std::vector<int>& loaded, Nanoseconds stamp) {
  const Skeleton& skeleton = part.tree().skeleton;
  const bool by_depth = static_cast<Promotion>(settings_.promotion) == Promotion::DEPTH;
  std::vector<double> score;
  if (by_depth)
    score = scoreByDepth(skeleton, loaded);
  else
    score = predictDeflection(skeleton, part.wood(), expectedLoads(tree, part));
  for (const int branch : loaded) score[static_cast<std::size_t>(branch)] = LOADED;
  std::vector<double> rank = score;  // what is physical already counts before what is not
  for (const SubtreeJoint& joint : part.joints()) {
    double& held = rank[static_cast<std::size_t>(joint.branch)];
    held = std::max(held, LOADED * (1.0 - 0.5 / (1.0 + held)));
  }
  std::size_t others = 0;
  for (const auto& [id, other] : parts_)
    if (id != tree) others += other.joints().size();
  const auto most = static_cast<std::size_t>(settings_.most_branches);
  const double threshold = by_depth ? 0.0 : settings_.influence_tolerance;
  const Selection selection = selectBranches(skeleton, rank, threshold, KEEP * threshold,
                                             part.mask(), most > others ? most - others : 0);
  for (const SubtreeJoint& joint : part.joints())  // beyond the cap: makes room for what is loaded
    if (!std::binary_search(selection.branches.begin(), selection.branches.end(), joint.branch))
      score[static_cast<std::size_t>(joint.branch)] = 0.0;
  const ProceduralMotion motion = scratch_.motionOf(part.tree(), airOf(at, tree), stamp);
  refused_[tree] = selection.refused +
                   part.promote(selection.branches, score, KEEP * threshold, motion, settings_);
}

// What the springs, pushes and bodies do to a tree now, or will as soon as they have pulled it to
// their targets.
std::vector<BranchLoad> ForestPhysics::expectedLoads(std::uint32_t tree,
                                                     const PhysicalSubtree& part) const {
  std::vector<BranchLoad> out;
  for (const auto& [id, grab] : grabs_) {
    if (grab.point.tree != tree) continue;
    const Branch& b = part.tree().skeleton.branches[static_cast<std::size_t>(grab.point.branch)];
    const Vec3 way = grab.target - part.tree().foot - pointOn(b.rest, grab.point.along);
    const double distance = length(way);
    Vec3 force = holds_.at(id).force;
    if (distance > 1e-9) {
      const Vec3 direction = way / distance;
      const double give = compliance(part.tree().skeleton, part.wood(), grab.point.branch,
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
void ForestPhysics::step(const StepContext& at, Nanoseconds from, Nanoseconds to, std::size_t k,
                         std::size_t n) {
  const auto stamp_of = [&](std::size_t i) {
    return from + (to - from) * static_cast<Nanoseconds>(i) / static_cast<Nanoseconds>(n);
  };
  for (auto& [tree, part] : parts_) {
    if (part.empty()) continue;
    gather(tree, part.tree().foot, from, to);
    addPushes(tree, stamp_of(k), stamp_of(k + 1));
    if (k == 0) accumulateLoads(at, tree, part, from, from);
    loads_.air = NEVER;
    loads_.hold = false;
    if (isNear(tree)) {
      stepTouching(at, tree, part, stamp_of(k), stamp_of(k + 1));
      continue;
    }
    const std::size_t first = k - k % AIR_STEPS, last = std::min(first + AIR_STEPS, n);
    loads_.air = (stamp_of(first) + stamp_of(last)) / 2;
    loads_.hold = k != first;
    part.step(airOf(at, tree), loads_, settings_, stamp_of(k), stamp_of(k + 1), scratch_);
    accumulateLoads(at, tree, part, stamp_of(k), stamp_of(k + 1));
  }
}

// Springs on a tree. Targets move in a straight line from tick to tick.
void ForestPhysics::gather(std::uint32_t tree, const Vec3& foot, Nanoseconds from, Nanoseconds to) {
  loads_.springs.clear();
  loads_.forces.clear();
  const double seconds = secondsBetween(from, to);
  for (const auto& [id, grab] : grabs_) {
    if (grab.point.tree != tree) continue;
    Vec3 velocity = Vec3::Zero();
    if (seconds > 0.0) velocity = (grab.target - holds_.at(id).target) / seconds;
    loads_.springs.push_back({grab.point, grab.target - foot, velocity, to, grab.stiffness,
                              grab.damping, grab.force_limit});
  }
}

// Forces on a tree in a step: means, such that each push gives its whole impulse.
void ForestPhysics::addPushes(std::uint32_t tree, Nanoseconds from, Nanoseconds to) {
  for (const Push& push : pushes_) {
    const Nanoseconds begin = std::max(push.from, from), end = std::min(push.until, to);
    if (push.point.tree != tree || end <= begin) continue;
    const double share = secondsBetween(begin, end) / secondsBetween(from, to);
    loads_.forces.push_back({push.point.branch, push.point.along, share * push.force});
  }
}

// After the last step: what the bodies feel, and who may be procedural again.
void ForestPhysics::settle(const StepContext& at, Nanoseconds from, Nanoseconds to) {
  reactToBodies(steps_);
  for (auto& [tree, part] : parts_) {
    if (to <= from) {
      gather(tree, part.tree().foot, from, to);
      accumulateLoads(at, tree, part, to, to);
    }
    react(tree, part, secondsBetween(from, to));
    part.demote(scratch_.motionOf(part.tree(), airOf(at, tree), to), settings_, scratch_);
  }
  for (auto& [id, hold] : holds_) hold.target = grabs_.at(id).target;
  pushes_.erase(std::remove_if(pushes_.begin(), pushes_.end(),
                               [&](const Push& push) { return push.until <= to; }),
                pushes_.end());
  for (auto it = parts_.begin(); it != parts_.end();)
    it = it->second.empty() && !isLoaded(it->first) ? parts_.erase(it) : std::next(it);
  if (!parts_.empty()) return;
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

// What the hands on a tree give it between two moments: springs by where the points are at both,
// dampers by the way between. So the damper's impulse is exact, and the spring's the step's own. Of
// one moment: a tick begins.
void ForestPhysics::accumulateLoads(const StepContext& at, std::uint32_t tree,
                                    const PhysicalSubtree& part, Nanoseconds from, Nanoseconds to) {
  if (loads_.springs.empty()) return;
  part.placesAt(loads_.springs, airOf(at, tree), to, scratch_, scratch_.places);
  const double h = secondsBetween(from, to);
  std::size_t spring = 0;
  for (auto& [id, grab] : grabs_) {
    if (grab.point.tree != tree) continue;
    const SubtreeSpring& held = loads_.springs[spring];
    Hold& hold = holds_[id];
    const Vec3 before = hold.place;
    hold.place = scratch_.places[spring++];
    if (part.linkOf(grab.point.branch) < 0) continue;
    if (h <= 0.0) {
      const SpringForce now = forceOf(held, to, hold.place, held.velocity);
      hold.force = now.force;
      hold.impulse = Vec3::Zero();
      hold.limited = now.scale < 1.0;
      continue;
    }
    const SpringForce mean = forceOf(held, from + (to - from) / 2, 0.5 * (before + hold.place),
                                     (hold.place - before) / h);
    hold.impulse += h * mean.force;
    hold.limited = hold.limited || mean.scale < 1.0;
  }
}

// Reactions of the springs on a tree: means over the tick, which carry their whole impulse; where
// time has leapt, what the springs have now.
void ForestPhysics::react(std::uint32_t tree, const PhysicalSubtree& part, double duration) {
  for (auto& [id, grab] : grabs_) {
    if (grab.point.tree != tree || part.linkOf(grab.point.branch) < 0) continue;
    Hold& hold = holds_[id];
    if (duration > 0.0) hold.force = hold.impulse / duration;
    Reaction out;
    out.grab = id;
    out.frame = grab.frame;
    out.at = grab.point;
    out.point = part.tree().foot + hold.place;
    out.force = -hold.force;
    out.limited = hold.limited;
    reactions_.push_back(out);
  }
}

TreeWind ForestPhysics::airOf(const StepContext& at, std::uint32_t tree) const {
  return {at.wind, at.levels.of(tree), at.layout.motion, at.modes.find(tree)};
}

}  // namespace vegetation_sim::forest
