// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/physics/tree_steps.h"

#include <algorithm>

namespace vegetation_sim::forest {
namespace {

/// Steps within this time use the wind of one stamp.
constexpr Nanoseconds AIR_PERIOD = NANOSECONDS_PER_SECOND / 60 + 1;

std::size_t stepsOfAir(const StepTimes& times) {
  const Nanoseconds steps =
      static_cast<Nanoseconds>(times.count) * AIR_PERIOD / (times.to - times.from);
  return std::max<std::size_t>(1, static_cast<std::size_t>(steps));
}

}  // namespace

/// The surroundings of one run.
struct TreeSteps::Run {
  const TickContext& tick;
  TreeWind air;
  SubtreeScratch& scratch;
};

StepTimes TreeSteps::timesIn(const TickContext& tick) const {
  StepTimes out = tick.times;
  const bool is_free = grabs_.empty() && pushes_.empty() && !contacts_;
  if (is_free && tick.settings.dynamics == physics::Dynamics::ARTICULATED &&
      tick.settings.integrator == physics::Integrator::MIDPOINT &&
      secondsBetween(subtree_->lastNeeded(), out.from) >= CALM_AFTER)
    out.count = (out.count + CALM_STEPS - 1) / CALM_STEPS;
  return out;
}

void TreeSteps::run(const TickContext& tick, SubtreeScratch& scratch) {
  const StepTimes& times = tick.times;
  const Run run{tick, tick.forest.windOf(tree_), scratch};
  collectSprings(times);
  accumulateImpulses(run.air, run.scratch, times.from, times.from);
  for (std::size_t k = 0; k < times.count; ++k) step(run, k);
  recordGrabs(secondsBetween(times.from, times.to));
  subtree_->demote(run.air, times.to, tick.settings, scratch);
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
  const std::size_t together = stepsOfAir(times), first = k - k % together,
                    last = std::min(first + together, times.count);
  loads_.air = (times.at(first) + times.at(last)) / 2;
  loads_.hold = k != first;
  subtree_->step(run.air, loads_, run.tick.settings, from, to, run.scratch);
  accumulateImpulses(run.air, run.scratch, from, to);
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
    return accumulateImpulses(run.air, run.scratch, from, to);
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
  accumulateImpulses(run.air, run.scratch, from, to);
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
