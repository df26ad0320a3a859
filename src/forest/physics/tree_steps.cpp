// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/physics/tree_steps.h"

#include <algorithm>

namespace vegetation_sim::forest {
namespace {

/// Steps that use the wind of one stamp: 60 Hz.
constexpr std::size_t AIR_STEPS = 4;

}  // namespace

/// The surroundings of one run.
struct TreeSteps::Run {
  const TickContext& tick;
  TreeWind air;
  SubtreeScratch& scratch;
};

void TreeSteps::run(const TickContext& tick, SubtreeScratch& scratch) {
  const StepTimes& times = tick.times;
  const Run run{tick, tick.forest.windOf(tree_), scratch};
  collectSprings(times);
  accumulateImpulses(run, times.from, times.from);
  for (std::size_t k = 0; k < times.count; ++k) step(run, k);
  recordGrabs(secondsBetween(times.from, times.to));
  subtree_->demote(run.air, times.to, tick.settings, tick.review, scratch);
}

// Targets move in a straight line between ticks.
void TreeSteps::collectSprings(const StepTimes& times) {
  const double seconds = secondsBetween(times.from, times.to);
  for (const HeldGrab* grab : grabs_) {
    Vec3 velocity = Vec3::Zero();
    if (seconds > 0.0) velocity = (grab->target - grab->last_target) / seconds;
    loads_.springs.push_back({grab->point, grab->target - subtree_->tree().foot, velocity, times.to,
                              grab->stiffness, grab->damping, grab->force_limit});
  }
}

// Forces are means over a step, so that each push has its whole impulse.
void TreeSteps::setPushes(Nanoseconds from, Nanoseconds to) {
  loads_.forces.clear();
  for (const Push* push : pushes_) {
    const Nanoseconds begin = std::max(push->from, from), end = std::min(push->until, to);
    if (end <= begin) continue;
    const double share = secondsBetween(begin, end) / secondsBetween(from, to);
    loads_.forces.push_back({push->point.branch, push->point.along, share * push->force});
  }
}

// Step number k.
void TreeSteps::step(const Run& run, std::size_t k) {
  const StepTimes& times = run.tick.times;
  const Nanoseconds from = times.at(k), to = times.at(k + 1);
  setPushes(from, to);
  if (contacts_) return stepNearBodies(run, k);
  const std::size_t first = k - k % AIR_STEPS, last = std::min(first + AIR_STEPS, times.count);
  loads_.air = (times.at(first) + times.at(last)) / 2;
  loads_.hold = k != first;
  subtree_->step(run.air, loads_, run.tick.settings, from, to, run.scratch);
  accumulateImpulses(run, from, to);
}

// Adds the impulse of the grabs between two stamps: springs by the positions at both, dampers by
// the displacement. Equal stamps begin a tick.
void TreeSteps::accumulateImpulses(const Run& run, Nanoseconds from, Nanoseconds to) {
  if (grabs_.empty()) return;
  std::vector<Vec3>& places = run.scratch.places;
  subtree_->placesAt(loads_.springs, run.air, to, run.scratch, places);
  const double h = secondsBetween(from, to);
  for (std::size_t i = 0; i < grabs_.size(); ++i) {
    HeldGrab& grab = *grabs_[i];
    const SubtreeSpring& spring = loads_.springs[i];
    const Vec3 before = grab.grip;
    grab.grip = places[i];
    if (subtree_->linkOf(grab.point.branch) < 0) continue;
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

// Reactions of springs are means over the tick, with their whole impulse; after a gap in time, the
// present forces.
void TreeSteps::recordGrabs(double duration) {
  for (HeldGrab* grab : grabs_) {
    if (subtree_->linkOf(grab->point.branch) < 0) continue;
    if (duration > 0.0) grab->force = grab->impulse / duration;
    Reaction out;
    out.grab = grab->id;
    out.frame = grab->frame;
    out.holder = grab->holder;
    out.at = grab->point;
    out.point = subtree_->tree().foot + grab->grip;
    out.force = -grab->force;
    out.limited = grab->limited;
    grab_reactions_.push_back(out);
  }
}

// ---- bodies ------------------------------------------------------------------------------------

void TreeSteps::stepNearBodies(const Run& run, std::size_t k) {
  SubtreeScratch& scratch = run.scratch;
  const Nanoseconds from = run.tick.times.at(k), to = run.tick.times.at(k + 1);
  const ContactTree tree{tree_, subtree_->tree().foot, subtree_->branches(),
                         subtree_->tree().skeleton, scratch.start};
  subtree_->kinematicsAt(run.air, from, scratch, scratch.start);
  const int count = run.tick.forest.contacts.countSubsteps(tree, run.tick.bodies, from, to);
  Nanoseconds now = from;
  SubstepBisection bisection;
  for (int i = 1; i <= count; ++i) {
    const Nanoseconds next = from + (to - from) * i / count;
    if (i > 1) subtree_->kinematicsAt(run.air, now, scratch, scratch.start);
    substep(run, tree, k, now, next, bisection);
    now = next;
  }
  coarse_ += bisection.ranOut();
}

// Takes a substep of step k, from the state in scratch.start.
void TreeSteps::substep(const Run& run, const ContactTree& tree, std::size_t k, Nanoseconds from,
                        Nanoseconds to, SubstepBisection& bisection) {
  const StepContext& forest = run.tick.forest;
  const PhysicsSettings& settings = run.tick.settings;
  const Bodies& bodies = run.tick.bodies;
  const StepTimes& times = run.tick.times;
  SubtreeScratch& scratch = run.scratch;
  const PersistentContacts before = *contacts_;
  std::vector<physics::Contact> contacts =
      forest.contacts.findContacts(tree, bodies, from, to, *contacts_);
  if (contacts.empty()) {
    subtree_->step(run.air, loads_, settings, from, to, scratch);
    return accumulateImpulses(run, from, to);
  }
  const PhysicalSubtree::SavedState start = subtree_->saveState();
  subtree_->stepWithContacts(run.air, loads_, settings, from, to, scratch, contacts);
  if (bisection.bisect(scratch.contact_stepper, settings.contact, to - from)) {
    const Nanoseconds middle = from + (to - from) / 2;
    subtree_->restoreState(start);
    *contacts_ = before;
    substep(run, tree, k, from, middle, bisection);
    subtree_->kinematicsAt(run.air, middle, scratch, scratch.start);
    return substep(run, tree, k, middle, to, bisection);
  }
  accumulateImpulses(run, from, to);
  std::vector<Reaction> reactions;
  forest.contacts.recordForces(tree, bodies, contacts, to, *contacts_, reactions);
  const double share =
      static_cast<double>(to - from) / static_cast<double>(times.at(k + 1) - times.at(k));
  for (Reaction& reaction : reactions) reaction.force *= share;
  accumulateReactions(k, reactions);
}

// Keeps one reaction per body and branch: the sum of forces, at the point of equal moment if they
// are parallel, with the largest penetration.
void TreeSteps::accumulateReactions(std::size_t k, const std::vector<Reaction>& reactions) {
  for (const Reaction& reaction : reactions) {
    const auto same = std::find_if(contact_reactions_.begin(), contact_reactions_.end(),
                                   [&](const StepReaction& other) {
                                     return other.reaction.at.branch == reaction.at.branch &&
                                            other.reaction.body == reaction.body;
                                   });
    if (same == contact_reactions_.end()) {
      contact_reactions_.push_back({k, reaction});
      continue;
    }
    const Reaction before = same->reaction;
    Reaction& sum = same->reaction = reaction;
    const double more = length(reaction.force), share = more / (more + length(before.force));
    sum.point = before.point + share * (reaction.point - before.point);
    sum.at.along = before.at.along + share * (reaction.at.along - before.at.along);
    sum.force += before.force;
    sum.limited = before.limited || reaction.limited;
    sum.penetration = std::max(before.penetration, reaction.penetration);
  }
}

}  // namespace vegetation_sim::forest
