// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/archive/archive.h"
#include "tree/physical/physical_subtree.h"
#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim::forest {
namespace {

// Rounding in single precision may exceed the limits by little.
constexpr double ROUNDING = 1.0 + 1e-6;
constexpr std::size_t JOINT_BYTES = 69;

}  // namespace

void PhysicalSubtree::archive(Archive& a) {
  const int last = static_cast<int>(mask_.size()) - 1;
  const physics::ChainState& state = state_.get();
  std::vector<Joined> all;
  for (std::size_t i = 0; i < joints_.size(); ++i)
    all.push_back({joints_[i], state.q[i], state.rate[i]});
  const auto pair = [&a](const char* name, physics::Vec2& value, double limit) {
    a.number(name, value.x(), {-ROUNDING * limit, ROUNDING * limit});
    a.number(name, value.y(), {-ROUNDING * limit, ROUNDING * limit});
  };
  a.list("joints", all, mask_.size(), JOINT_BYTES, [&](Joined& joined) {
    SubtreeJoint& joint = joined.joint;
    a.integer("joint branch", joint.branch, 0, last);
    a.stamp("joint promoted", joint.promoted);
    a.stamp("joint needed", joint.needed);
    a.stamp("joint blend", joint.blend);
    a.number("joint compensation", joint.compensation, {0.0, 1.0});
    a.flag("joint wanted", joint.wanted);
    pair("joint bend", joined.q, LARGEST_BEND);
    pair("joint rate", joined.rate, FASTEST_BEND);
  });
  a.number("theta", theta_, {0.5, 1.0});
  a.stamp("next review of a tree", next_review_);
  if (!a.reads()) return;
  std::vector<char> mask(mask_.size(), 0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int branch = all[i].joint.branch;
    if (i > 0 && branch <= all[i - 1].joint.branch) Archive::rejectOrder("joints", i);
    if (leavesGap(mask, branch))
      Archive::reject("joint branch = " + std::to_string(branch),
                      "is not allowed: an ancestor is physical, but not its parent");
    mask[static_cast<std::size_t>(branch)] = 1;
  }
  rebuild(all);
}

}  // namespace vegetation_sim::forest
