// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/physics/tree_steps.h"

#include <algorithm>

namespace vegetation_sim::forest {
namespace {

/// Steps that use the wind of one stamp: 60 Hz.
constexpr std::size_t AIR_STEPS = 4;

/// Distances from the held point to the springs of a grab, along the branch [m].
class SpringOffsets {
 public:
  explicit SpringOffsets(double jaw_length)
      : size_(jaw_length > 0.0 ? 2 : 1), offsets_{-0.5 * jaw_length, 0.5 * jaw_length} {}
  std::size_t size() const { return size_; }
  double share() const { return 1.0 / static_cast<double>(size_); }  ///< of each in the whole
  double operator[](std::size_t i) const { return offsets_[i]; }
  const double* begin() const { return offsets_; }
  const double* end() const { return offsets_ + size_; }

 private:
  std::size_t size_;
  double offsets_[2];
};

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
    const Vec3 direction = jawDirection(*grab);
    const SpringOffsets offsets(grab->jaw_length);
    for (const double offset : offsets) {
      const Vec3 target = grab->target + offset * direction;
      const Vec3 last = grab->last_target + offset * grab->last_direction;
      Vec3 velocity = Vec3::Zero();
      if (seconds > 0.0) velocity = (target - last) / seconds;
      BranchPoint point = grab->point;
      point.along += offset;
      loads_.springs.push_back({point, target - subtree_->tree().foot, velocity, times.to,
                                grab->stiffness * offsets.share(), grab->damping * offsets.share(),
                                grab->force_limit * offsets.share()});
    }
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
  const SubtreeSpring* springs = loads_.springs.data();
  const Vec3* place = places.data();
  for (HeldGrab* grab : grabs_) {
    const std::size_t count = SpringOffsets(grab->jaw_length).size();
    accumulateImpulse(springs, place, from, to, *grab);
    springs += count;
    place += count;
  }
}

// Adds the impulse of one grab, whose springs are at `places` now.
void TreeSteps::accumulateImpulse(const SubtreeSpring* springs, const Vec3* places,
                                  Nanoseconds from, Nanoseconds to, HeldGrab& grab) const {
  const SpringOffsets offsets(grab.jaw_length);
  const Vec3 grip = grab.grip, axis = grab.axis;  // before
  grab.grip = places[0];
  if (offsets.size() == 2) {
    grab.grip = 0.5 * (places[0] + places[1]);
    grab.axis = (places[1] - places[0]) / grab.jaw_length;
  }
  if (subtree_->linkOf(grab.point.branch) < 0) return;
  const double h = secondsBetween(from, to);
  const bool begins = h <= 0.0;
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  bool limited = false;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const double offset = offsets[i];
    const Vec3 was = grip + offset * axis;
    const SpringForce f = begins ? forceOf(springs[i], to, places[i], springs[i].velocity)
                                 : forceOf(springs[i], from + (to - from) / 2,
                                           0.5 * (was + places[i]), (places[i] - was) / h);
    const Vec3 arm = offset * (begins ? grab.axis : Vec3(0.5 * (axis + grab.axis)));
    force += f.force;
    torque += cross(arm, f.force);
    limited = limited || f.scale < 1.0;
  }
  if (begins) {
    grab.force = force;
    grab.torque = torque;
    grab.impulse = grab.angular_impulse = Vec3::Zero();
    grab.limited = limited;
  } else {
    grab.impulse += h * force;
    grab.angular_impulse += h * torque;
    grab.limited = grab.limited || limited;
  }
}

// Reactions of springs are means over the tick, with their whole impulse; after a gap in time, the
// present forces.
void TreeSteps::recordGrabs(double duration) {
  for (HeldGrab* grab : grabs_) {
    if (subtree_->linkOf(grab->point.branch) < 0) continue;
    if (duration > 0.0) {
      grab->force = grab->impulse / duration;
      grab->torque = grab->angular_impulse / duration;
    }
    Reaction out;
    out.grab = grab->id;
    out.frame = grab->frame;
    out.holder = grab->holder;
    out.at = grab->point;
    out.point = subtree_->tree().foot + grab->grip;
    out.force = -grab->force;
    out.torque -= grab->torque;  // without a jaw +0, which -0 would not equal bit by bit
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
