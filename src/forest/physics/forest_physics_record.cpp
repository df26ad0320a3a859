// Figures and hash of the physics of a forest.
#include "forest/physics/forest_physics.h"
#include "tree/growth/broken_branch.h"
#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim::forest {

PhysicsFigures ForestPhysics::figures() const {
  PhysicsFigures out;
  for (const auto& entry : subtrees_) {
    const PhysicalSubtree& subtree = entry.second;
    if (subtree.empty()) continue;
    ++out.trees;
    out.branches += subtree.joints().size();
    out.blending += subtree.blending();
    out.bytes += subtree.bytes();
  }
  out.steps = steps_;
  for (const auto& entry : refused_) out.refused += entry.second;
  out.skipped = skipped_;
  out.coarse = coarse_;
  out.broken = countBroken(broken_);
  for (const SubtreeScratch& scratch : scratches_) out.replaced += scratch.replaced;
  for (const Reaction& reaction : reactions_) out.capped_forces += reaction.limited ? 1 : 0;
  return out;
}

std::size_t ForestPhysics::branchCount() const {
  std::size_t out = 0;
  for (const auto& entry : subtrees_) out += entry.second.joints().size();
  return out;
}

void ForestPhysics::addTo(Hash& hash) const {
  PhysicsSettings settings = settings_;
  FieldHasher hasher(hash);
  describe(hasher, settings);
  const auto add = [&](const BranchPoint& point) {
    hash.add(static_cast<std::uint64_t>(point.tree));
    hash.add(static_cast<std::uint64_t>(point.branch));
    hash.add(point.along);
  };
  hash.add(static_cast<std::uint64_t>(next_grab_));
  for (const auto& [id, grab] : grabs_) {
    hash.add(static_cast<std::uint64_t>(id));
    add(grab.point);
    hash.add(grab.target);
    hash.add(grab.last_target);
    for (const double v : {grab.stiffness, grab.damping, grab.force_limit, grab.lease}) hash.add(v);
    if (grab.jaw_length > 0.0) {
      hash.add(grab.jaw_length);
      hash.add(jawDirection(grab));
      hash.add(grab.last_direction);
    }
    hash.add(grab.frame);
    hash.add(static_cast<std::uint64_t>(grab.renewed));
  }
  for (const Push& push : pushes_) {
    add(push.point);
    hash.add(push.force);
    for (const Nanoseconds stamp : {push.until, push.from})
      hash.add(static_cast<std::uint64_t>(stamp));
  }
  for (const BranchCut& cut : cuts_) {
    hash.add(static_cast<std::uint64_t>(cut.tree));
    hash.add(static_cast<std::uint64_t>(cut.branch));
  }
  forest::addTo(hash, broken_);
  for (const auto& [id, body] : bodies_) {
    hash.add(id);
    forest::addTo(hash, body);
  }
  for (const auto& [tree, subtree] : subtrees_) {
    if (subtree.empty()) continue;
    hash.add(static_cast<std::uint64_t>(tree));
    subtree.addTo(hash);
  }
  for (const auto& [tree, contacts] : persistent_contacts_) {
    for (const PersistentContact& contact : contacts) {
      hash.add(static_cast<std::uint64_t>(tree));
      hash.add(contact.body);
      hash.add(static_cast<std::uint64_t>(contact.branch));
      hash.add(contact.normal);
      hash.add(contact.along);
      hash.add(contact.gap);
      hash.add(contact.force);
      hash.add(std::uint64_t{contact.released});
    }
  }
}

}  // namespace vegetation_sim::forest
