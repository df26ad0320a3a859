// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "forest/physics/forest_physics.h"

namespace vegetation_sim::forest {
namespace {

constexpr std::size_t MOST_GRABS = 256, MOST_PUSHES = 256, MOST_BODIES = 256;
constexpr double REACH_FACTOR = 2.0;  // maximum distance of a target from the foot in tree sizes

std::string count(std::size_t value) {
  return std::to_string(value);
}

// Throws unless the tree exists and can be physical.
void checkTree(const Layout& layout, const std::string& what, std::uint32_t tree) {
  if (layout.treeCount() == 0) throw InvalidInput(what + ": there are no trees");
  if (tree >= layout.treeCount())
    throw InvalidInput(what + ": tree = " + count(tree) + " is unknown, allowed are 0 to " +
                           count(layout.treeCount() - 1),
                       FaultCode::UNKNOWN);
  if (layout.motion.joint_model != JointModel::SWING)
    throw InvalidInput(what + ": joint_model = paper has no physical motion, allowed is swing");
}

void checkPoint(const Tree& tree, const std::string& what, const BranchPoint& point,
                Faults& faults) {
  const auto& branches = tree.skeleton.branches;
  if (point.branch < 0 || point.branch >= static_cast<int>(branches.size())) {
    faults.add(what + ": branch = " + std::to_string(point.branch) +
                   " is unknown, allowed are 0 to " + count(branches.size() - 1),
               FaultCode::UNKNOWN);
    return;
  }
  if (branches[static_cast<std::size_t>(point.branch)].broken)
    return faults.add(what + ": branch = " + std::to_string(point.branch) + " has come off",
                      FaultCode::UNKNOWN);
  const double most = branches[static_cast<std::size_t>(point.branch)].length;
  const std::string fault = rangeFault(what + ": along", point.along, "m", {0.0, most});
  if (!fault.empty()) faults.add(fault);
}

void checkTarget(const Vec3& target, const Vec3& foot, double reach, Faults& faults) {
  Vec3 copy = target;
  FieldChecker("grab: ", faults).vector("target", copy, "m", {-1e7, 1e7});
  if (!faults.empty()) return;
  const std::string fault = rangeFault("grab: distance of target from the tree's foot",
                                       length(target - foot), "m", {0.0, reach});
  if (!fault.empty()) faults.add(fault);
}

// Maximum distance of targets from the tree's foot [m].
double reachOf(const Tree& tree) {
  return REACH_FACTOR * (tree.skeleton.height + tree.skeleton.reach);
}

// Removes a subtree that was added to check a request, unless the request is accepted.
class SubtreeGuard {
 public:
  using Subtrees = std::map<std::uint32_t, PhysicalSubtree>;
  template <typename Add>
  SubtreeGuard(Subtrees& subtrees, std::uint32_t tree, const Add& add)
      : subtrees_(subtrees), tree_(tree), added_(!subtrees.count(tree)) {
    if (added_) add();
  }
  ~SubtreeGuard() {
    if (added_) subtrees_.erase(tree_);
  }
  SubtreeGuard(const SubtreeGuard&) = delete;
  SubtreeGuard& operator=(const SubtreeGuard&) = delete;
  const Tree& tree() const { return subtrees_.at(tree_).tree(); }
  void accept() { added_ = false; }

 private:
  Subtrees& subtrees_;
  std::uint32_t tree_;
  bool added_;
};

template <typename Map, typename Key>
auto& findKnown(Map& map, const Key& key, const std::string& what) {
  const auto found = map.find(key);
  if (found != map.end()) return found->second;
  throw InvalidInput(what + " is unknown", FaultCode::UNKNOWN);
}

}  // namespace

void checkGrab(const Layout& layout, const Tree& tree, const Grab& grab) {
  checkTree(layout, "grab", grab.point.tree);
  Faults faults;
  check(grab, faults);
  checkPoint(tree, "grab", grab.point, faults);
  if (faults.empty()) checkTarget(grab.target, tree.foot, reachOf(tree), faults);
  faults.throwIfAny();
}

void checkTarget(const Tree& tree, const Vec3& target) {
  Faults faults;
  checkTarget(target, tree.foot, reachOf(tree), faults);
  faults.throwIfAny();
}

void checkPush(const Layout& layout, const Tree& tree, const Push& push) {
  checkTree(layout, "push", push.point.tree);
  Faults faults;
  check(push, faults);
  checkPoint(tree, "push", push.point, faults);
  faults.throwIfAny();
}

// Throws InvalidInput unless the loaded branch can become physical.
void ForestPhysics::checkRoom(const std::string& what, std::uint32_t tree, int branch) const {
  const auto subtree = subtrees_.find(tree);
  if (subtree != subtrees_.end() && subtree->second.linkOf(branch) >= 0) return;
  std::size_t held = 0;
  for (const auto& entry : subtrees_) held += entry.second.joints().size();
  if (held >= static_cast<std::size_t>(settings_.most_branches))
    throw InvalidInput(what + ": most_branches = " + std::to_string(settings_.most_branches) +
                       " are physical already");
}

void ForestPhysics::checkRoomForTree(const std::string& what, const Tree& tree,
                                     std::uint32_t id) const {
  std::size_t others = 0;
  for (const auto& [other, subtree] : subtrees_)
    if (other != id) others += subtree.joints().size();
  const std::size_t branches = tree.skeleton.branches.size();
  const auto most = static_cast<std::size_t>(settings_.most_branches);
  if (others + branches > most)
    throw InvalidInput(what + ": whole_tree: tree " + count(id) + " has " + count(branches) +
                       " branches, and most_branches = " + count(most) + " leaves room for " +
                       count(most - std::min(most, others)));
}

PhysicalSubtree& ForestPhysics::findOrAddSubtree(const StepContext& context, std::uint32_t tree) {
  const auto found = subtrees_.find(tree);
  if (found != subtrees_.end()) return found->second;
  auto grown = std::make_shared<const Tree>(grow(context, tree));
  const Species& species = context.layout.species[grown->seed.species];
  const auto material = settings_.material;
  return subtrees_.emplace(tree, PhysicalSubtree(std::move(grown), species, material))
      .first->second;
}

std::uint32_t ForestPhysics::addGrab(const StepContext& context, const Grab& request) {
  HeldGrab grab{request};
  checkTree(context.layout, "grab", grab.point.tree);
  context.owners.requireOwned("grab", grab.point.tree);
  if (grabs_.size() >= MOST_GRABS)
    throw InvalidInput("grab: there are " + count(grabs_.size()) + " grabs, allowed are " +
                       count(MOST_GRABS));
  if (grab.id == 0) grab.id = nextIdOf(context.owners.shard(), next_grab_);
  if (grabs_.count(grab.id))
    throw InvalidInput("grab: id = " + count(grab.id) + " is in use, allowed is 0 for a new one");
  SubtreeGuard subtree(subtrees_, grab.point.tree,
                       [&] { findOrAddSubtree(context, grab.point.tree); });
  const Tree& tree = subtree.tree();
  checkGrab(context.layout, tree, grab);
  checkRoom("grab", grab.point.tree, grab.point.branch);
  subtree.accept();
  next_grab_ = std::max(next_grab_, grab.id + 1);
  grab.last_target = grab.target;
  grab.last_direction = jawDirection(grab);
  grab.max_target_distance = reachOf(tree);
  grab.foot = tree.foot;
  grabs_[grab.id] = grab;
  requestReview(context, grab.point.tree);
  return grab.id;
}

void ForestPhysics::moveGrab(std::uint32_t id, const Vec3& target, const Pose& holder) {
  HeldGrab& grab = findKnown(grabs_, id, "grab: id = " + count(id));
  Faults faults;
  checkTarget(target, grab.foot, grab.max_target_distance, faults);
  checkHolder(holder, faults);
  faults.throwIfAny();
  grab.target = target;
  grab.holder = holder;
  grab.renewed_since_tick = true;
}

void ForestPhysics::renewGrab(std::uint32_t id) {
  findKnown(grabs_, id, "grab: id = " + count(id)).renewed_since_tick = true;
}

void ForestPhysics::release(std::uint32_t id) {
  const HeldGrab& grab = findKnown(grabs_, id, "grab: id = " + count(id));
  // The force that decays from now on acts on the holder where it was last.
  for (Reaction& reaction : reactions_)
    if (reaction.kind == Reaction::GRAB && reaction.grab == id) reaction.holder = grab.holder;
  grabs_.erase(id);
}

void ForestPhysics::push(const StepContext& context, const Push& push) {
  checkTree(context.layout, "push", push.point.tree);
  context.owners.requireOwned("push", push.point.tree);
  if (pushes_.size() >= MOST_PUSHES)
    throw InvalidInput("push: there are " + count(pushes_.size()) + " pushes, allowed are " +
                       count(MOST_PUSHES));
  SubtreeGuard subtree(subtrees_, push.point.tree,
                       [&] { findOrAddSubtree(context, push.point.tree); });
  checkPush(context.layout, subtree.tree(), push);
  checkRoom("push", push.point.tree, push.point.branch);
  if (push.whole_tree) checkRoomForTree("push", subtree.tree(), push.point.tree);
  subtree.accept();
  pushes_.push_back(push);
  requestReview(context, push.point.tree);
}

void ForestPhysics::setBody(const Body& body) {
  Faults faults;
  check(body, faults);
  if (!bodies_.count(body.id) && bodies_.size() >= MOST_BODIES)
    faults.add("body " + inQuotes(body.id) + " is one more than the " + count(MOST_BODIES) +
               " allowed");
  faults.throwIfAny();
  bodies_[body.id] = body;
}

void ForestPhysics::removeBody(const std::string& id) {
  findKnown(bodies_, id, "body " + inQuotes(id));
  bodies_.erase(id);
}

void ForestPhysics::setSettings(const PhysicsSettings& settings, Nanoseconds now) {
  Faults faults;
  PhysicsSettings copy = settings;
  FieldChecker checker("physics: ", faults);
  describe(checker, copy);
  faults.throwIfAny();
  for (auto& entry : subtrees_) entry.second.stretchBlends(now, settings_.blend, settings.blend);
  const bool other_wood = settings.material != settings_.material;
  settings_ = settings;
  if (other_wood)
    for (auto& entry : subtrees_) entry.second.setMaterial(settings.material);
  next_review_ = 0;
  for (auto& entry : subtrees_) entry.second.setNextReview(0);
}

void ForestPhysics::clear() {
  const PhysicsSettings settings = settings_;
  *this = ForestPhysics();
  settings_ = settings;
}

}  // namespace vegetation_sim::forest
