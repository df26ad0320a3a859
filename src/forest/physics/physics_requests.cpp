// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "forest/contact/contact_body.h"
#include "forest/physics/forest_physics.h"

namespace vegetation_sim::forest {
namespace {

constexpr std::size_t MOST_GRABS = 256, MOST_PUSHES = 256, MOST_BODIES = 256;
constexpr double REACH_FACTOR = 2.0;  // a target is at most so many tree sizes from the foot

std::string count(std::size_t value) {
  return std::to_string(value);
}

// The tree of a point is there, and can be physical.
void checkTree(const Layout& layout, const std::string& what, std::uint32_t tree) {
  if (layout.treeCount() == 0) throw InvalidInput(what + ": there are no trees");
  if (tree >= layout.treeCount())
    throw InvalidInput(what + ": tree = " + count(tree) + " is unknown, allowed are 0 to " +
                       count(layout.treeCount() - 1));
  if (static_cast<JointModel>(layout.motion.joint_model) != JointModel::SWING)
    throw InvalidInput(what + ": joint_model = paper has no physical motion, allowed is swing");
}

void checkPoint(const Tree& tree, const std::string& what, const BranchPoint& point,
                Faults& faults) {
  const auto& branches = tree.skeleton.branches;
  if (point.branch < 0 || point.branch >= static_cast<int>(branches.size())) {
    faults.add(what + ": branch = " + std::to_string(point.branch) +
               " is unknown, allowed are 0 to " + count(branches.size() - 1));
    return;
  }
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

// Targets are no farther from the tree's foot [m].
double reachOf(const Tree& tree) {
  return REACH_FACTOR * (tree.skeleton.height + tree.skeleton.reach);
}

// A part that is there to look at its tree: it goes again unless the request is accepted.
class Provisional {
 public:
  using Parts = std::map<std::uint32_t, PhysicalSubtree>;
  template <typename Make>
  Provisional(Parts& parts, std::uint32_t tree, const Make& make)
      : parts_(parts), tree_(tree), mine_(!parts.count(tree)) {
    if (mine_) make();
  }
  ~Provisional() {
    if (mine_) parts_.erase(tree_);
  }
  Provisional(const Provisional&) = delete;
  Provisional& operator=(const Provisional&) = delete;
  const PhysicalSubtree& get() const { return parts_.at(tree_); }
  void keep() { mine_ = false; }

 private:
  Parts& parts_;
  std::uint32_t tree_;
  bool mine_;
};

template <typename Map, typename Key>
auto& known(Map& map, const Key& key, const std::string& what) {
  const auto found = map.find(key);
  if (found != map.end()) return found->second;
  throw InvalidInput(what + " is unknown");
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

// At least the loaded branch must find room.
void ForestPhysics::checkRoom(const std::string& what, std::uint32_t tree, int branch) const {
  const auto part = parts_.find(tree);
  if (part != parts_.end() && part->second.linkOf(branch) >= 0) return;
  std::size_t held = 0;
  for (const auto& entry : parts_) held += entry.second.joints().size();
  if (held >= static_cast<std::size_t>(settings_.most_branches))
    throw InvalidInput(what + ": most_branches = " + std::to_string(settings_.most_branches) +
                       " are physical already");
}

PhysicalSubtree& ForestPhysics::partOf(const StepContext& at, std::uint32_t tree) {
  const auto found = parts_.find(tree);
  if (found != parts_.end()) return found->second;
  auto grown = std::make_shared<const Tree>(growTree(at.layout, tree, at.terrain));
  const Species& species = at.layout.species[grown->seed.species];
  const auto material = static_cast<Material>(settings_.material);
  return parts_.emplace(tree, PhysicalSubtree(std::move(grown), species, material)).first->second;
}

std::uint32_t ForestPhysics::addGrab(const StepContext& at, Grab grab) {
  checkTree(at.layout, "grab", grab.point.tree);
  if (grabs_.size() >= MOST_GRABS)
    throw InvalidInput("grab: there are " + count(grabs_.size()) + " grabs, allowed are " +
                       count(MOST_GRABS));
  if (grab.id == 0) grab.id = next_grab_;
  if (grabs_.count(grab.id))
    throw InvalidInput("grab: id = " + count(grab.id) + " is in use, allowed is 0 for a new one");
  Provisional part(parts_, grab.point.tree, [&] { partOf(at, grab.point.tree); });
  const Tree& grown = part.get().tree();
  checkGrab(at.layout, grown, grab);
  checkRoom("grab", grab.point.tree, grab.point.branch);
  part.keep();
  next_grab_ = std::max(next_grab_, grab.id + 1);
  grabs_[grab.id] = grab;
  holds_[grab.id] = {grab.target, true, reachOf(grown), grown.foot};
  next_review_ = 0;
  return grab.id;
}

void ForestPhysics::moveGrab(std::uint32_t id, const Vec3& target) {
  Grab& grab = known(grabs_, id, "grab: id = " + count(id));
  Hold& hold = holds_[id];
  Faults faults;
  checkTarget(target, hold.foot, hold.reach, faults);
  faults.throwIfAny();
  grab.target = target;
  hold.renewed = true;
}

void ForestPhysics::renewGrab(std::uint32_t id) {
  known(grabs_, id, "grab: id = " + count(id));
  holds_[id].renewed = true;
}

void ForestPhysics::release(std::uint32_t id) {
  known(grabs_, id, "grab: id = " + count(id));
  grabs_.erase(id);
  holds_.erase(id);
}

void ForestPhysics::push(const StepContext& at, const Push& push) {
  checkTree(at.layout, "push", push.point.tree);
  if (pushes_.size() >= MOST_PUSHES)
    throw InvalidInput("push: there are " + count(pushes_.size()) + " pushes, allowed are " +
                       count(MOST_PUSHES));
  Provisional part(parts_, push.point.tree, [&] { partOf(at, push.point.tree); });
  checkPush(at.layout, part.get().tree(), push);
  checkRoom("push", push.point.tree, push.point.branch);
  part.keep();
  pushes_.push_back(push);
  next_review_ = 0;
}

void ForestPhysics::setBody(const Body& body) {
  Faults faults;
  check(body, faults);
  if (!bodies_.count(body.id) && bodies_.size() >= MOST_BODIES)
    faults.add("body '" + body.id + "' is one more than the " + count(MOST_BODIES) + " allowed");
  faults.throwIfAny();
  bodies_[body.id] = body;
}

void ForestPhysics::removeBody(const std::string& id) {
  known(bodies_, id, "body '" + id + "'");
  bodies_.erase(id);
}

void ForestPhysics::setSettings(const PhysicsSettings& settings, Nanoseconds now) {
  Faults faults;
  PhysicsSettings copy = settings;
  FieldChecker checker("physics: ", faults);
  describe(checker, copy);
  faults.throwIfAny();
  for (auto& entry : parts_) entry.second.stretchBlends(now, settings_.blend, settings.blend);
  const bool other_wood = settings.material != settings_.material;
  settings_ = settings;
  if (other_wood)
    for (auto& entry : parts_) entry.second.setMaterial(static_cast<Material>(settings.material));
  next_review_ = 0;
}

void ForestPhysics::clear() {
  const PhysicsSettings settings = settings_;
  *this = ForestPhysics();
  settings_ = settings;
}

}  // namespace vegetation_sim::forest
