// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Steps of trees that bodies touch, and what the bodies feel.
#include <algorithm>

#include "forest/physics/forest_physics.h"

namespace vegetation_sim::forest {

bool ForestPhysics::isNear(std::uint32_t tree) const {
  return std::binary_search(near_.begin(), near_.end(), tree);
}

bool SubstepBisection::want(const physics::ContactStepper& stepper, const physics::ContactLaw& law,
                            Nanoseconds part) {
  const bool coarse =
      stepper.forceChange() > MAX_FORCE_CHANGE * law.force_limit || !stepper.agreed();
  return coarse && part >= 2 * SHORTEST && ++wanted_ <= MOST;
}

void ForestPhysics::stepTouching(const StepContext& at, std::uint32_t tree, PhysicalSubtree& part,
                                 Nanoseconds from, Nanoseconds to) {
  const ContactModel::Wood wood{tree, part.tree().foot, part.branches(), part.tree().skeleton,
                                scratch_.start};
  part.kinematicsAt(airOf(at, tree), from, scratch_, scratch_.start);
  const int parts = at.contacts->partsOf(wood, bodies_, from, to);
  Nanoseconds now = from;
  SubstepBisection bisection;
  for (int k = 1; k <= parts; ++k) {
    const Nanoseconds next = from + (to - from) * k / parts;
    if (k > 1) part.kinematicsAt(airOf(at, tree), now, scratch_, scratch_.start);
    stepAmong(at, wood, part, now, next, to - from, bisection);
    now = next;
  }
  coarse_ += bisection.ranOut();
}

// A part of a step `whole` long, from where scratch_.start tells.
void ForestPhysics::stepAmong(const StepContext& at, const ContactModel::Wood& wood,
                              PhysicalSubtree& part, Nanoseconds from, Nanoseconds to,
                              Nanoseconds whole, SubstepBisection& bisection) {
  Touches& touches = touches_[wood.tree];
  const Touches before = touches;
  std::vector<physics::Contact> contacts =
      at.contacts->findContacts(wood, bodies_, from, to, touches);
  const TreeWind air = airOf(at, wood.tree);
  if (contacts.empty()) {
    part.step(air, loads_, settings_, from, to, scratch_);
    return accumulateLoads(at, wood.tree, part, from, to);
  }
  const PhysicalSubtree::Moment start = part.moment();
  part.stepTouching(air, loads_, settings_, from, to, scratch_, contacts);
  if (bisection.want(scratch_.contact_stepper, settings_.contact, to - from)) {
    const Nanoseconds middle = from + (to - from) / 2;
    part.goBack(start);
    touches = before;
    stepAmong(at, wood, part, from, middle, whole, bisection);
    part.kinematicsAt(air, middle, scratch_, scratch_.start);
    return stepAmong(at, wood, part, middle, to, whole, bisection);
  }
  accumulateLoads(at, wood.tree, part, from, to);
  std::vector<Reaction> reactions;
  at.contacts->settle(wood, bodies_, contacts, to, touches, reactions);
  const double share = static_cast<double>(to - from) / static_cast<double>(whole);
  for (Reaction& reaction : reactions) reaction.force *= share;
  addTouches(reactions);
}

// One a body and branch: the sum of its forces where they have the same moment if they are
// parallel, its worst.
void ForestPhysics::addTouches(const std::vector<Reaction>& reactions) {
  for (const Reaction& reaction : reactions) {
    const auto same = std::find_if(touching_.begin(), touching_.end(), [&](const Reaction& other) {
      return other.at.tree == reaction.at.tree && other.at.branch == reaction.at.branch &&
             other.body == reaction.body;
    });
    if (same == touching_.end()) {
      touching_.push_back(reaction);
      continue;
    }
    const Reaction before = *same;
    *same = reaction;
    const double more = length(reaction.force), share = more / (more + length(before.force));
    same->point = before.point + share * (reaction.point - before.point);
    same->at.along = before.at.along + share * (reaction.at.along - before.at.along);
    same->force += before.force;
    same->limited = before.limited || reaction.limited;
    same->penetration = std::max(before.penetration, reaction.penetration);
  }
}

// The mean force of the tick carries its whole impulse, however short a knock was.
void ForestPhysics::reactToBodies(std::size_t steps) {
  contact_loads_.clear();
  for (Reaction& reaction : touching_) {
    reaction.force /= static_cast<double>(steps);
    contact_loads_[reaction.at.tree].push_back(
        {reaction.at.branch, reaction.at.along, Vec3(-reaction.force)});
    reactions_.push_back(reaction);
  }
  touching_.clear();
}

// Nobody feels a force vanish: what was told at the last tick falls no faster than contacts rise,
// and what has ended is told down to zero. Bodies that are gone feel nothing.
void ForestPhysics::decay(const std::vector<Reaction>& published, double duration) {
  const double most = settings_.contact.force_rate * std::max(0.0, duration);
  for (const Reaction& before : published) {
    const double force = length(before.force), left = std::max(0.0, force - most);
    const auto same = std::find_if(reactions_.begin(), reactions_.end(), [&](const Reaction& r) {
      return r.kind == before.kind && r.grab == before.grab && r.body == before.body &&
             r.at.tree == before.at.tree && r.at.branch == before.at.branch;
    });
    if (same != reactions_.end()) {
      const double now = length(same->force);
      if (now < left) same->force = (left / force) * before.force;
      continue;
    }
    if (force <= 0.0) continue;
    const bool gone = before.kind == Reaction::CONTACT && !bodies_.count(before.body);
    Reaction falling = before;
    falling.force *= gone ? 0.0 : left / force;
    falling.torque *= gone ? 0.0 : left / force;
    falling.limited = false;
    falling.penetration = 0.0;
    reactions_.push_back(falling);
  }
}

}  // namespace vegetation_sim::forest
