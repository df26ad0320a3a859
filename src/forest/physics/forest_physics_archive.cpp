// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Reading and writing of the physics of a forest.
#include <algorithm>

#include "core/archive/archive.h"
#include "forest/contact/contact_body.h"
#include "forest/physics/forest_physics.h"
#include "tree/growth/broken_branch.h"

namespace vegetation_sim::forest {
namespace {

constexpr std::size_t LONGEST_NAME = 4096;  // of bodies and frames
constexpr std::size_t MOST_ENTRIES = 1u << 16;
constexpr std::size_t MOST_CONTACTS = 1u << 20;
// Least bytes of entries.
constexpr std::size_t GRAB_BYTES = 378, PUSH_BYTES = 56, BODY_BYTES = 200, REACTION_BYTES = 160,
                      CONTACT_BYTES = 61, LOAD_BYTES = 36;

/// Writes or reads points of the branches of one layout.
class Points {
 public:
  Points(Archive& a, const Layout& layout)
      : a_(a), last_(static_cast<std::uint32_t>(layout.treeCount()) - 1) {}
  void tree(std::uint32_t& id) const { a_.integer<std::uint32_t>("tree", id, 0, last_); }
  void branch(int& branch) const { a_.integer("branch", branch, 0, MAX_BRANCHES - 1); }
  void point(BranchPoint& point) const {
    tree(point.tree);
    branch(point.branch);
    a_.number("along", point.along);
  }

 private:
  Archive& a_;
  std::uint32_t last_;
};

void archive(Archive& a, const Points& points, Grab& grab) {
  points.point(grab.point);
  a.vector("grab target", grab.target);
  a.number("grab stiffness", grab.stiffness);
  a.number("grab damping", grab.damping);
  a.number("grab force_limit", grab.force_limit);
  a.text("grab frame", grab.frame, LONGEST_NAME);
  a.number("grab lease", grab.lease);
  a.integer("grab id", grab.id);
  a.stamp("grab renewed", grab.renewed);
  a.vector("grab offset", grab.offset);
  a.pose("grab holder", grab.holder);
  a.number("grab jaw_length", grab.jaw_length);
  a.vector("grab direction", grab.direction);
}

void archive(Archive& a, const Points& points, HeldGrab& grab) {
  archive(a, points, static_cast<Grab&>(grab));
  a.vector("grab last_target", grab.last_target);
  a.flag("grab renewed_since_tick", grab.renewed_since_tick);
  a.number("grab max_target_distance", grab.max_target_distance, {0.0, 2.0 * LARGEST_TREE});
  a.vector("grab foot", grab.foot);
  a.vector("grab force", grab.force);
  a.vector("grab grip", grab.grip);
  a.vector("grab impulse", grab.impulse);
  a.vector("grab last_direction", grab.last_direction);
  a.vector("grab axis", grab.axis);
  a.vector("grab torque", grab.torque);
  a.vector("grab angular_impulse", grab.angular_impulse);
  a.flag("grab limited", grab.limited);
}

void archive(Archive& a, const Points& points, Push& push) {
  points.point(push.point);
  a.vector("push force", push.force);
  a.stamp("push until", push.until);
  a.stamp("push from", push.from);
  a.flag("push whole_tree", push.whole_tree);
}

void archive(Archive& a, const Points& points, Reaction& reaction) {
  a.integer("reaction kind", reaction.kind, Reaction::GRAB, Reaction::CONTACT);
  a.integer("reaction grab", reaction.grab);
  a.text("reaction body", reaction.body, LONGEST_NAME);
  a.text("reaction frame", reaction.frame, LONGEST_NAME);
  a.pose("reaction holder", reaction.holder);
  points.point(reaction.at);
  a.vector("reaction point", reaction.point);
  a.vector("reaction force", reaction.force);
  a.vector("reaction torque", reaction.torque);
  a.flag("reaction limited", reaction.limited);
  a.number("reaction penetration", reaction.penetration);
}

void archive(Archive& a, const Points& points, PersistentContact& contact) {
  a.text("contact body", contact.body, LONGEST_NAME);
  points.branch(contact.branch);
  a.vector("contact normal", contact.normal);
  a.number("contact gap", contact.gap);
  a.number("contact force", contact.force);
  a.number("contact along", contact.along);
  a.flag("contact released", contact.released);
}

void archiveCount(Archive& a, const char* name, std::size_t& count) {
  auto wide = static_cast<std::uint64_t>(count);
  a.integer(name, wide);
  count = static_cast<std::size_t>(wide);
}

}  // namespace

void ForestPhysics::archive(Archive& a, const Layout& layout, const GrowTree& grow) {
  const Points points(a, layout);
  a.fields("physics", settings_);
  archiveSubtrees(a, layout, grow);
  a.map(
      "grabs", grabs_, MOST_ENTRIES, GRAB_BYTES, [&a](std::uint32_t& id) { a.integer("grab", id); },
      [&](std::uint32_t, HeldGrab& grab) { forest::archive(a, points, grab); });
  a.list("pushes", pushes_, MOST_ENTRIES, PUSH_BYTES,
         [&](Push& push) { forest::archive(a, points, push); });
  a.map(
      "bodies", bodies_, MOST_ENTRIES, BODY_BYTES,
      [&a](std::string& id) { a.text("body", id, LONGEST_NAME); },
      [&a](const std::string&, Body& body) { archiveBody(a, body); });
  archiveContacts(a, layout);
  a.list("ended grabs", ended_, MOST_ENTRIES, GRAB_BYTES / 2, [&](EndedGrab& grab) {
    forest::archive(a, points, static_cast<Grab&>(grab));
    a.integer("reason of an ended grab", grab.reason, EndedGrab::LEASE_EXPIRED,
              EndedGrab::BRANCH_BROKEN);
  });
  a.list("reactions", reactions_, MOST_CONTACTS, REACTION_BYTES,
         [&](Reaction& reaction) { forest::archive(a, points, reaction); });
  a.list("cuts", cuts_, MOST_ENTRIES, sizeof(std::uint32_t) + sizeof(int), [&](BranchCut& cut) {
    points.tree(cut.tree);
    points.branch(cut.branch);
  });
  a.integer<std::uint32_t>("next grab", next_grab_, 1);
  a.stamp("next review", next_review_);
  archiveCount(a, "steps", steps_);
  archiveCount(a, "skipped", skipped_);
  archiveCount(a, "coarse", coarse_);
  if (a.reads()) checkRead(layout, grow);
}

void ForestPhysics::archiveBroken(Archive& a, const Layout& layout) {
  forest::archiveBroken(a, layout.treeCount(), broken_);
  if (a.reads()) forgetGrown();
}

void ForestPhysics::archiveSubtrees(Archive& a, const Layout& layout, const GrowTree& grow) {
  const Points points(a, layout);
  constexpr std::size_t TREE_BYTES = 16;
  const std::size_t trees = a.length("subtrees", subtrees_.size(), layout.treeCount(), TREE_BYTES);
  if (!a.reads()) {
    for (auto& [id, subtree] : subtrees_) {
      std::uint32_t tree = id;
      points.tree(tree);
      subtree.archive(a);
    }
    return;
  }
  subtrees_.clear();
  for (std::size_t i = 0; i < trees; ++i) {
    std::uint32_t tree = 0;
    points.tree(tree);
    if (!subtrees_.empty() && tree <= subtrees_.rbegin()->first)
      Archive::rejectOrder("subtrees", i);
    std::shared_ptr<const Tree> grown = grow(tree);
    const Species& species = layout.species[grown->seed.species];
    PhysicalSubtree subtree(std::move(grown), species, settings_.material);
    subtree.archive(a);
    subtrees_.emplace_hint(subtrees_.end(), tree, std::move(subtree));
  }
}

void ForestPhysics::archiveContacts(Archive& a, const Layout& layout) {
  const Points points(a, layout);
  const auto tree = [&](std::uint32_t& id) { points.tree(id); };
  a.map("contacts", persistent_contacts_, MOST_CONTACTS, 8, tree,
        [&](std::uint32_t, PersistentContacts& contacts) {
          a.list("contacts of a tree", contacts, MOST_CONTACTS, CONTACT_BYTES / 2,
                 [&](PersistentContact& contact) { forest::archive(a, points, contact); });
        });
  a.map("contact loads", contact_loads_, MOST_CONTACTS, 8, tree,
        [&](std::uint32_t, std::vector<BranchLoad>& loads) {
          a.list("contact loads of a tree", loads, MOST_CONTACTS, LOAD_BYTES,
                 [&](BranchLoad& load) {
                   points.branch(load.branch);
                   a.number("load along", load.along);
                   a.vector("load force", load.force);
                 });
        });
  a.map("refused branches", refused_, MOST_CONTACTS, 12, tree,
        [&](std::uint32_t, std::size_t& count) { archiveCount(a, "refused", count); });
  a.list("trees near bodies", near_, MOST_CONTACTS, 4, tree);
}

// The numbers are in range; checks here that everything is on branches that there are.
void ForestPhysics::checkRead(const Layout& layout, const GrowTree& grow) const {
  Faults faults;
  const auto tree_of = [&](std::uint32_t id) -> std::shared_ptr<const Tree> {
    const auto found = subtrees_.find(id);
    if (found == subtrees_.end()) return grow(id);
    return {std::shared_ptr<const Tree>(), &found->second.tree()};
  };
  for (const auto& entry : broken_) tree_of(entry.first);  // throws for a branch that it lacks
  for (const auto& [id, grab] : grabs_) {
    if (grab.id != id || id >= next_grab_)
      Archive::reject("grab id = " + std::to_string(grab.id),
                      "is not allowed: it has to be its key and below the next id");
    checkGrab(layout, *tree_of(grab.point.tree), grab);
  }
  for (const Push& push : pushes_) checkPush(layout, *tree_of(push.point.tree), push);
  for (const BranchCut& cut : cuts_) checkCut(layout, *tree_of(cut.tree), cut);
  for (const auto& [id, body] : bodies_) {
    if (body.id != id) Archive::reject("body id = " + inQuotes(body.id), "is not its key");
    check(body, faults);
  }
  const auto branch_of = [&](std::uint32_t tree, int branch) {
    const std::size_t count = tree_of(tree)->skeleton.branches.size();
    if (static_cast<std::size_t>(branch) >= count)
      faults.add("branch = " + std::to_string(branch) + " is outside 0 to " +
                 std::to_string(count - 1));
  };
  for (const auto& [tree, contacts] : persistent_contacts_)
    for (const PersistentContact& contact : contacts) branch_of(tree, contact.branch);
  for (const auto& [tree, loads] : contact_loads_)
    for (const BranchLoad& load : loads) branch_of(tree, load.branch);
  for (const Reaction& reaction : reactions_) branch_of(reaction.at.tree, reaction.at.branch);
  for (std::size_t i = 1; i < near_.size(); ++i)
    if (near_[i] <= near_[i - 1]) Archive::rejectOrder("trees near bodies", i);
  faults.throwIfAny();
}

}  // namespace vegetation_sim::forest
