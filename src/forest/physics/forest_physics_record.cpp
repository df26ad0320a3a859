// Figures and hash of the physics of a forest.
#include "forest/physics/forest_physics.h"
#include "tree/growth/broken_branch.h"
#include "tree/state/tree_hashes.h"
#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim::forest {
namespace {

void addRecord(Hash& hash, const BranchPoint& point) {
  hash.add(static_cast<std::uint64_t>(point.tree));
  hash.add(static_cast<std::uint64_t>(point.branch));
  hash.add(point.along);
}

// All but its id.
void addRecord(Hash& hash, const HeldGrab& grab) {
  addRecord(hash, grab.point);
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

void addRecord(Hash& hash, const Push& push) {
  addRecord(hash, push.point);
  hash.add(push.force);
  for (const Nanoseconds stamp : {push.until, push.from})
    hash.add(static_cast<std::uint64_t>(stamp));
  if (push.whole_tree) hash.add(std::uint64_t{1});
}

void addRecord(Hash& hash, const BranchCut& cut) {
  hash.add(static_cast<std::uint64_t>(cut.tree));
  hash.add(static_cast<std::uint64_t>(cut.branch));
}

// All but its tree.
void addRecord(Hash& hash, const PersistentContact& contact) {
  hash.add(contact.body);
  hash.add(static_cast<std::uint64_t>(contact.branch));
  hash.add(contact.normal);
  hash.add(contact.along);
  hash.add(contact.gap);
  hash.add(contact.force);
  hash.add(std::uint64_t{contact.released});
}

}  // namespace

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
  out.unbroken = unbroken_;
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
  hash.add(static_cast<std::uint64_t>(next_grab_));
  for (const auto& [id, grab] : grabs_) {
    hash.add(static_cast<std::uint64_t>(id));
    addRecord(hash, grab);
  }
  for (const Push& push : pushes_) addRecord(hash, push);
  for (const BranchCut& cut : cuts_) addRecord(hash, cut);
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
      addRecord(hash, contact);
    }
  }
}

void ForestPhysics::addTo(TreeHashes& hashes) const {
  for (const auto& entry : grabs_)
    addRecord(hashes.of(entry.second.point.tree, TreeHashes::GRAB), entry.second);
  for (const Push& push : pushes_) addRecord(hashes.of(push.point.tree, TreeHashes::PUSH), push);
  for (const BranchCut& cut : cuts_) addRecord(hashes.of(cut.tree, TreeHashes::CUT), cut);
  for (const auto& [tree, pieces] : broken_)
    for (const BrokenBranch& piece : pieces)
      forest::addTo(hashes.of(tree, TreeHashes::BROKEN), piece);
  for (const auto& [tree, subtree] : subtrees_)
    if (!subtree.empty()) subtree.addTo(hashes.of(tree, TreeHashes::JOINTS));
  for (const auto& [tree, contacts] : persistent_contacts_)
    for (const PersistentContact& contact : contacts)
      addRecord(hashes.of(tree, TreeHashes::CONTACT), contact);
}

}  // namespace vegetation_sim::forest
