// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/forest.h"

namespace vegetation_sim::forest {

std::uint32_t Forest::addGrab(const Grab&) {
  throw InvalidInput("grab: not yet");
}
void Forest::moveGrab(std::uint32_t, const Vec3&) {
  throw InvalidInput("grab: not yet");
}
void Forest::renewGrab(std::uint32_t) {
  throw InvalidInput("grab: not yet");
}
void Forest::release(std::uint32_t) {
  throw InvalidInput("grab: not yet");
}
void Forest::push(const Push&) {
  throw InvalidInput("push: not yet");
}
void Forest::setBody(const Body&) {
  throw InvalidInput("body: not yet");
}
void Forest::removeBody(const std::string&) {
  throw InvalidInput("body: not yet");
}
void Forest::setPhysics(const PhysicsSettings&) {
  throw InvalidInput("physics: not yet");
}
void Forest::setContactModel(std::shared_ptr<const ContactModel>) {}

const PhysicsSettings& Forest::physicsSettings() const {
  static const PhysicsSettings NONE;
  return NONE;
}
const std::map<std::uint32_t, Grab>& Forest::grabs() const {
  static const std::map<std::uint32_t, Grab> NONE;
  return NONE;
}
const Bodies& Forest::bodies() const {
  static const Bodies NONE;
  return NONE;
}
const std::vector<Grab>& Forest::ended() const {
  static const std::vector<Grab> NONE;
  return NONE;
}
const std::vector<Reaction>& Forest::reactions() const {
  static const std::vector<Reaction> NONE;
  return NONE;
}
PhysicsFigures Forest::physicsFigures() const {
  return {};
}
PromotedTree Forest::promoted(std::uint32_t) const {
  return {};
}
std::vector<std::uint32_t> Forest::physicalTrees() const {
  return {};
}

std::vector<Pose> Forest::pose(const Tree& tree, std::uint32_t id, Nanoseconds stamp) const {
  return poseBranches(tree, memory_.wind.at(stamp).relativeTo(tree.foot),
                      weightsAt(memory_.levels.of(id), stamp, layout_.motion), promoted(id), stamp);
}

}  // namespace vegetation_sim::forest
