// Reactions on the bodies that trees touch.
#include <algorithm>

#include "forest/physics/tree_steps.h"

namespace vegetation_sim::forest {
namespace {

constexpr double TORQUE_LEVER = 0.1;  // [m]

}  // namespace

bool ForestPhysics::isNear(std::uint32_t tree) const {
  return std::binary_search(near_.begin(), near_.end(), tree);
}

// The mean force over the tick has the whole impulse of a short impact. Reactions are in the order
// of the steps in which they began, then of the trees.
void ForestPhysics::publishContactReactions(const std::vector<TreeSteps>& trees) {
  contact_loads_.clear();
  std::vector<StepReaction> all;
  for (const TreeSteps& steps : trees)
    all.insert(all.end(), steps.contactReactions().begin(), steps.contactReactions().end());
  std::stable_sort(all.begin(), all.end(),
                   [](const StepReaction& a, const StepReaction& b) { return a.step < b.step; });
  for (StepReaction& entry : all) {
    Reaction& reaction = entry.reaction;
    reaction.force /= static_cast<double>(steps_);
    contact_loads_[reaction.at.tree].push_back(
        {reaction.at.branch, reaction.at.along, Vec3(-reaction.force)});
    reactions_.push_back(reaction);
  }
}

// A published reaction decays no faster than the contact law allows, also after its contact or grab
// has ended; its torque counts as a force at a lever of TORQUE_LEVER. Reactions of removed bodies
// become zero at once.
void ForestPhysics::decayReactions(const std::vector<Reaction>& published, double duration) {
  const double most = settings_.contact.force_rate * std::max(0.0, duration);
  for (const Reaction& before : published) {
    const double force = length(before.force), torque = length(before.torque);
    const double size = std::max(force, torque / TORQUE_LEVER);
    const double share = size > 0.0 ? std::max(0.0, size - most) / size : 0.0;
    const auto same = std::find_if(reactions_.begin(), reactions_.end(), [&](const Reaction& r) {
      return r.kind == before.kind && r.grab == before.grab && r.body == before.body &&
             r.at.tree == before.at.tree && r.at.branch == before.at.branch;
    });
    if (same != reactions_.end()) {
      if (length(same->force) < share * force) same->force = share * before.force;
      if (length(same->torque) < share * torque) same->torque = share * before.torque;
      continue;
    }
    if (size <= 0.0) continue;
    const bool gone = before.kind == Reaction::CONTACT && !bodies_.count(before.body);
    Reaction falling = before;
    falling.force *= gone ? 0.0 : share;
    falling.torque *= gone ? 0.0 : share;
    falling.limited = false;
    falling.penetration = 0.0;
    reactions_.push_back(falling);
  }
}

}  // namespace vegetation_sim::forest
