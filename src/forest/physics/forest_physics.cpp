// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/physics/forest_physics.h"

#include <algorithm>

#include "forest/physics/tree_steps.h"

namespace vegetation_sim::forest {
namespace {

/// Physical branches stay so down to this fraction of the tolerance (hysteresis).
constexpr double KEEP = 0.5;
/// A force of a grab up to this one needs no more physical branches at once [N].
constexpr double WEAK_PULL = 1.0;

std::size_t physicalSteps(Nanoseconds from, Nanoseconds to) {
  const Nanoseconds gap = to - from;
  return static_cast<std::size_t>((gap * PHYSICS_RATE + NANOSECONDS_PER_SECOND - 1) /
                                  NANOSECONDS_PER_SECOND);
}

// Splits trees into ranges with about equally many branches; returns the end of each.
std::vector<std::size_t> splitByBranches(const std::vector<TreeSteps>& trees, std::size_t parts) {
  std::size_t all = 0, sum = 0;
  for (const TreeSteps& steps : trees) all += steps.branchCount();
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const std::size_t middle = sum + trees[i].branchCount() / 2;
    while (out.size() + 1 < parts && middle * parts >= all * (out.size() + 1)) out.push_back(i);
    sum += trees[i].branchCount();
  }
  out.resize(parts, trees.size());
  return out;
}

// Reviews of single trees begin at multiples of REVIEW, so that they depend neither on other trees
// nor on when the process started.
Nanoseconds firstReview(Nanoseconds start) {
  return (start + REVIEW - 1) / REVIEW * REVIEW;
}

Vec3 pointOn(const Pose& pose, double along) {
  return pose.position + along * axisZ(pose.orientation);
}

}  // namespace

void ForestPhysics::advance(const StepContext& context, Nanoseconds to) {
  ended_.clear();
  breaks_.clear();
  before_.clear();
  const std::vector<Reaction> published = std::move(reactions_);
  reactions_.clear();
  steps_ = 0;
  for (SubtreeScratch& scratch : scratches_) {
    scratch.replaced = 0;
    scratch.windows.clear();
  }
  endLeases(to);
  if (!subtrees_.empty() || !grabs_.empty() || !pushes_.empty() || !bodies_.empty())
    stepAll(context, to);
  else
    context.contacts.releaseTrees();
  cutBranches(context, to);
  decayReactions(published, secondsBetween(context.stamp, to));
}

void ForestPhysics::stepAll(const StepContext& context, Nanoseconds to) {
  const Nanoseconds from = context.stamp;
  const bool gap = to <= from || to - from > LONGEST_GAP;
  if (gap && !subtrees_.empty()) ++skipped_;
  const Nanoseconds start = gap ? to : from;
  promoteLoaded(context, start, to);
  steps_ = subtrees_.empty() ? 0 : physicalSteps(start, to);
  stepTrees({context, settings_, bodies_, {start, to, steps_}});
  breakOverloaded(context, to);
  finishTick(to);
}

// Each thread steps tree after tree, so that each tree stays in the caches during its steps.
void ForestPhysics::stepTrees(const TickContext& tick) {
  std::vector<TreeSteps> trees;
  for (auto& [tree, subtree] : subtrees_)
    if (!subtree.empty()) trees.emplace_back(tree, subtree);
  const auto steps_of = [&](std::uint32_t tree) {
    const auto found = std::lower_bound(
        trees.begin(), trees.end(), tree,
        [](const TreeSteps& steps, std::uint32_t id) { return steps.tree() < id; });
    return found != trees.end() && found->tree() == tree ? &*found : nullptr;
  };
  for (auto& entry : grabs_)
    if (TreeSteps* steps = steps_of(entry.second.point.tree)) steps->add(entry.second);
  for (const Push& push : pushes_)
    if (TreeSteps* steps = steps_of(push.point.tree)) steps->add(push);
  for (const std::uint32_t tree : near_)
    if (TreeSteps* steps = steps_of(tree)) steps->setContacts(persistent_contacts_[tree]);
  const std::vector<std::size_t> ends = splitByBranches(trees, tick.forest.threads.size());
  if (scratches_.size() < ends.size()) scratches_.resize(ends.size());
  tick.forest.threads.run(ends.size(), [&](std::size_t part) {
    for (std::size_t i = part ? ends[part - 1] : 0; i < ends[part]; ++i)
      trees[i].run({tick.forest, tick.settings, tick.bodies, trees[i].timesIn(tick)},
                   scratches_[part]);
  });
  for (const TreeSteps& steps : trees) coarse_ += steps.coarseSteps();
  publishContactReactions(trees);
  for (const TreeSteps& steps : trees)
    reactions_.insert(reactions_.end(), steps.grabReactions().begin(), steps.grabReactions().end());
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
    ended_.push_back({grab, EndedGrab::LEASE_EXPIRED});
    it = grabs_.erase(it);
  }
}

void ForestPhysics::requestReview(const StepContext& context, std::uint32_t tree) {
  if (!context.reviews_by_tree) next_review_ = 0;
  const auto subtree = subtrees_.find(tree);
  if (subtree != subtrees_.end()) subtree->second.setNextReview(0);
}

void ForestPhysics::beginReviews(const StepContext& context, Nanoseconds start) {
  const bool is_due = start >= next_review_;
  if (is_due && !context.reviews_by_tree) next_review_ = start + REVIEW;
  for (auto& entry : subtrees_)
    if (context.reviews_by_tree)
      entry.second.beginTick(start);
    else
      entry.second.setInReview(is_due);
}

void ForestPhysics::promoteLoaded(const StepContext& context, Nanoseconds from, Nanoseconds to) {
  BranchesOfTrees loaded;
  const auto pose_tree = [&](const Tree& tree, std::uint32_t id, Nanoseconds stamp,
                             const ContactScene::Enters& enters) {
    const Weights weights = weightsAt(context.levels.of(id), stamp, context.layout.motion);
    return poseReached(tree, context.wind.at(stamp).relativeTo(tree.foot), weights,
                       context.modes.find(id), promoted(id, context.stamp), stamp, enters);
  };
  context.contacts.findNear({context.layout, context.layout_hash, context.terrain, pose_tree,
                             &context.grid, &broken_, &context.owners},
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
    if (push.from < to && push.until > from) {
      loaded[push.point.tree].push_back(push.point.branch);
      if (push.whole_tree) appendWholeTree(context, push.point.tree, loaded[push.point.tree]);
    }
  for (auto& [tree, subtree] : subtrees_)
    if (!loaded.count(tree)) subtree.releaseJoints();
  for (auto it = refused_.begin(); it != refused_.end();)
    it = loaded.count(it->first) ? std::next(it) : refused_.erase(it);
  for (const auto& entry : loaded)
    if (!subtrees_.count(entry.first))
      findOrAddSubtree(context, entry.first)
          .setNextReview(context.reviews_by_tree ? firstReview(from) : next_review_);
  beginReviews(context, from);
  for (const auto& [tree, branches] : loaded) {
    PhysicalSubtree& subtree = subtrees_.at(tree);
    bool missing = false;
    for (const int branch : branches) missing = missing || !subtree.holds(branch);
    if (subtree.isInReview() || missing || isPulledHarder(tree))
      promoteInTree(context, tree, subtree, branches, from);
  }
}

// Returns true if the target of a grab of the tree has moved so far since the last tick that its
// force may grow by half: such a pull needs its branches before the next review.
bool ForestPhysics::isPulledHarder(std::uint32_t tree) const {
  const auto grows = [&](const auto& entry) {
    const HeldGrab& grab = entry.second;
    if (grab.point.tree != tree) return false;
    const double pull = grab.stiffness * length(grab.target - grab.last_target);
    return std::min(pull, grab.force_limit) > std::max(WEAK_PULL, 0.5 * length(grab.force));
  };
  return std::any_of(grabs_.begin(), grabs_.end(), grows);
}

// Adds all branches of a tree that have not come off.
void ForestPhysics::appendWholeTree(const StepContext& context, std::uint32_t tree,
                                    std::vector<int>& loaded) {
  const auto& branches = findOrAddSubtree(context, tree).tree().skeleton.branches;
  for (std::size_t i = 0; i < branches.size(); ++i)
    if (!branches[i].broken) loaded.push_back(static_cast<int>(i));
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
  for (std::size_t i = 0; i < score.size(); ++i)
    if (skeleton.branches[i].broken) score[i] = 0.0;
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
  const ProceduralMotion motion =
      scratches_[0].motionOf(subtree.tree(), context.windOf(tree), stamp);
  const std::size_t held = subtree.holding();
  PromotedTree before = promoted(tree, context.stamp);
  refused_[tree] = selection.refused +
                   subtree.promote(selection.branches, score, KEEP * threshold, motion, settings_);
  if (subtree.holding() != held) before_[tree] = std::move(before);
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
    if (grab.jaw_length <= 0.0) continue;
    const Vec3 turning = cross(grab.torque, grab.axis) / grab.jaw_length;
    for (const double side : {-1.0, 1.0})
      out.push_back({grab.point.branch, grab.point.along + 0.5 * side * grab.jaw_length,
                     Vec3(side * turning)});
  }
  for (const Push& push : pushes_)
    if (push.point.tree == tree) out.push_back({push.point.branch, push.point.along, push.force});
  const auto touches = contact_loads_.find(tree);
  if (touches != contact_loads_.end())
    out.insert(out.end(), touches->second.begin(), touches->second.end());
  return out;
}

void ForestPhysics::finishTick(Nanoseconds to) {
  for (auto& [id, grab] : grabs_) {
    grab.last_target = grab.target;
    grab.last_direction = jawDirection(grab);
  }
  pushes_.erase(std::remove_if(pushes_.begin(), pushes_.end(),
                               [&](const Push& push) { return push.until <= to; }),
                pushes_.end());
  for (auto it = subtrees_.begin(); it != subtrees_.end();)
    it = it->second.empty() && !isLoaded(it->first) ? subtrees_.erase(it) : std::next(it);
  if (!subtrees_.empty()) return;
  scratches_ = std::vector<SubtreeScratch>(1);
}

bool ForestPhysics::isLoaded(std::uint32_t tree) const {
  if (isNear(tree)) return true;
  for (const auto& entry : grabs_)
    if (entry.second.point.tree == tree) return true;
  return std::any_of(pushes_.begin(), pushes_.end(),
                     [&](const Push& push) { return push.point.tree == tree; });
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
