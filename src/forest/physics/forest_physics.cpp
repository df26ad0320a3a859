// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// What a forest asks of its physics.
#include "forest/forest.h"

namespace vegetation_sim::forest {

StepContext Forest::site() const {
  return {layout_, *terrain_, memory_.wind, memory_.levels, memory_.modes, *this, contacts_.get()};
}

// Before the levels are chosen anew: those that hold now did so since the last tick.
void Forest::advancePhysics(Nanoseconds stamp) {
  for (const std::uint32_t tree : physicalTrees()) memory_.changed.insert(tree);
  memory_.modes.advance(memory_.wind, memory_.stamp, stamp);
  memory_.physics.advance(site(), memory_.stamp, stamp);
}

std::uint32_t Forest::addGrab(const Grab& grab) {
  return memory_.physics.addGrab(site(), grab);
}
void Forest::moveGrab(std::uint32_t id, const Vec3& target) {
  memory_.physics.moveGrab(id, target);
}
void Forest::renewGrab(std::uint32_t id) {
  memory_.physics.renewGrab(id);
}
void Forest::release(std::uint32_t id) {
  memory_.physics.release(id);
}
void Forest::push(const Push& push) {
  memory_.physics.push(site(), push);
}
void Forest::setBody(const Body& body) {
  memory_.physics.setBody(body);
}
void Forest::removeBody(const std::string& id) {
  memory_.physics.removeBody(id);
}
void Forest::setPhysics(const PhysicsSettings& settings) {
  memory_.physics.setSettings(settings, memory_.stamp);
}

PhysicsFigures Forest::physicsFigures() const {
  PhysicsFigures out = memory_.physics.figures();
  if (contacts_) out.bytes += contacts_->bytes();
  return out;
}

PromotedTree Forest::promoted(std::uint32_t tree) const {
  const double blend = memory_.physics.settings().blend;
  const auto found = memory_.physics.parts().find(tree);
  if (found == memory_.physics.parts().end()) return {memory_.stamp, blend, {}};
  return found->second.promoted(memory_.stamp, blend);
}

std::vector<std::uint32_t> Forest::physicalTrees() const {
  std::vector<std::uint32_t> out;
  for (const auto& [tree, part] : memory_.physics.parts())
    if (!part.empty()) out.push_back(tree);
  return out;
}

std::vector<Pose> Forest::pose(const Tree& tree, std::uint32_t id, Nanoseconds stamp) const {
  return poseBranches(tree, memory_.wind.at(stamp).relativeTo(tree.foot),
                      weightsAt(memory_.levels.of(id), stamp, layout_.motion), sway(id),
                      promoted(id), stamp);
}

}  // namespace vegetation_sim::forest
