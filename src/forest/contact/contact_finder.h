// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <mutex>

#include "dynamics/contact/contact.h"
#include "forest/contact/contact_model.h"
#include "vegetation_sim/tree/growth/skeleton.h"
#include "vegetation_sim/tree/motion/pose.h"

namespace vegetation_sim::forest {

/// Finds what bodies touch: over trees by their size, over branches by distance, then exactly, with
/// both in motion (docs/contact.md). Keeps the trees around bodies at hand, grown, until the first
/// tick at which none is near; what it finds does not depend on which.
class ContactFinder : public ContactModel {
 public:
  void findNear(const Forest& forest, const Bodies& bodies, Nanoseconds from, Nanoseconds to,
                BranchesOfTrees& near) const override;
  int partsOf(const Wood& wood, const Bodies& bodies, Nanoseconds from,
              Nanoseconds to) const override;
  std::vector<physics::Contact> findContacts(const Wood& wood, const Bodies& bodies,
                                             Nanoseconds from, Nanoseconds to,
                                             Touches& touches) const override;
  void settle(const Wood& wood, const Bodies& bodies, const std::vector<physics::Contact>& contacts,
              Nanoseconds to, Touches& touches, std::vector<Reaction>& reactions) const override;
  void releaseTrees() const override;
  std::size_t bytes() const override;

 private:
  using Trees = std::map<std::uint32_t, std::shared_ptr<const Tree>>;
  mutable std::mutex mutex_;
  mutable std::uint64_t layout_hash_{0};  // of the trees at hand
  mutable Trees trees_;
};

/// Ids of trees that may reach into a ball, rising. Cheap and generous: only sizes are looked at.
std::vector<std::uint32_t> treesNear(const Layout& layout, const terrain::HeightMap& terrain,
                                     const Vec3& centre, double radius);

/// From here on a branch stands out of the wood that bears it [m].
double outsideBearer(const Skeleton& skeleton, int branch);

/// A branch that a body comes nearer to than this, plus twice the way of both in a tick, is made
/// physical [m].
constexpr double NEAR = 0.1;

}  // namespace vegetation_sim::forest
