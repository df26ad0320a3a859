// Steps of trees near bodies, and the reactions on the bodies.
#include <algorithm>

#include "forest/physics/forest_physics.h"

namespace vegetation_sim::forest {

bool ForestPhysics::isNear(std::uint32_t tree) const {
  return std::binary_search(near_.begin(), near_.end(), tree);
}

void ForestPhysics::stepNearBodies(const StepContext& context, std::uint32_t tree,
                                   PhysicalSubtree& subtree, Nanoseconds from, Nanoseconds to) {
  const ContactTree contact_tree{tree, subtree.tree().foot, subtree.branches(),
                                 subtree.tree().skeleton, scratch_.start};
  subtree.kinematicsAt(windOf(context, tree), from, scratch_, scratch_.start);
  const int count = context.contacts.countSubsteps(contact_tree, bodies_, from, to);
  Nanoseconds now = from;
  SubstepBisection bisection;
  for (int k = 1; k <= count; ++k) {
    const Nanoseconds next = from + (to - from) * k / count;
    if (k > 1) subtree.kinematicsAt(windOf(context, tree), now, scratch_, scratch_.start);
    substep(context, contact_tree, subtree, now, next, to - from, bisection);
    now = next;
  }
  coarse_ += bisection.ranOut();
}

// Takes a substep of a step of duration `whole`, from the state in scratch_.start.
void ForestPhysics::substep(const StepContext& context, const ContactTree& tree,
                            PhysicalSubtree& subtree, Nanoseconds from, Nanoseconds to,
                            Nanoseconds whole, SubstepBisection& bisection) {
  PersistentContacts& persistent = persistent_contacts_[tree.tree];
  const PersistentContacts before = persistent;
  std::vector<physics::Contact> contacts =
      context.contacts.findContacts(tree, bodies_, from, to, persistent);
  const TreeWind air = windOf(context, tree.tree);
  if (contacts.empty()) {
    subtree.step(air, loads_, settings_, from, to, scratch_);
    return accumulateImpulses(context, tree.tree, subtree, from, to);
  }
  const PhysicalSubtree::SavedState start = subtree.saveState();
  subtree.stepWithContacts(air, loads_, settings_, from, to, scratch_, contacts);
  if (bisection.bisect(scratch_.contact_stepper, settings_.contact, to - from)) {
    const Nanoseconds middle = from + (to - from) / 2;
    subtree.restoreState(start);
    persistent = before;
    substep(context, tree, subtree, from, middle, whole, bisection);
    subtree.kinematicsAt(air, middle, scratch_, scratch_.start);
    return substep(context, tree, subtree, middle, to, whole, bisection);
  }
  accumulateImpulses(context, tree.tree, subtree, from, to);
  std::vector<Reaction> reactions;
  context.contacts.recordForces(tree, bodies_, contacts, to, persistent, reactions);
  const double share = static_cast<double>(to - from) / static_cast<double>(whole);
  for (Reaction& reaction : reactions) reaction.force *= share;
  accumulateReactions(reactions);
}

// Keeps one reaction per body and branch: the sum of forces, at the point of equal moment if they
// are parallel, with the largest penetration.
void ForestPhysics::accumulateReactions(const std::vector<Reaction>& reactions) {
  for (const Reaction& reaction : reactions) {
    const auto same = std::find_if(
        contact_reactions_.begin(), contact_reactions_.end(), [&](const Reaction& other) {
          return other.at.tree == reaction.at.tree && other.at.branch == reaction.at.branch &&
                 other.body == reaction.body;
        });
    if (same == contact_reactions_.end()) {
      contact_reactions_.push_back(reaction);
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

// The mean force over the tick has the whole impulse of a short impact.
void ForestPhysics::publishContactReactions() {
  contact_loads_.clear();
  for (Reaction& reaction : contact_reactions_) {
    reaction.force /= static_cast<double>(steps_);
    contact_loads_[reaction.at.tree].push_back(
        {reaction.at.branch, reaction.at.along, Vec3(-reaction.force)});
    reactions_.push_back(reaction);
  }
  contact_reactions_.clear();
}

// A published reaction decays no faster than the contact law allows, also after its contact or grab
// has ended. Reactions of removed bodies become zero at once.
void ForestPhysics::decayReactions(const std::vector<Reaction>& published, double duration) {
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
