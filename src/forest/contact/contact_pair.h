// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "forest/contact/contact_finder.h"
#include "vegetation_sim/dynamics/chain/chain.h"

namespace vegetation_sim::forest {

/// Within this gap a pair is a contact even without approach: springs may close it [m].
constexpr double SKIN = 5e-3;
/// The contact law evaluates the gap half a step after the end of the step.
constexpr double LOOK_AHEAD = 1.5;  // [steps]

/// A body at the start of a step, in the tree's frame.
struct Placed {
  const Body& body;
  Pose pose;
  Quat to_body;
  physics::RoundedBox shape;

  Placed(const Body& b, const Vec3& foot, Nanoseconds from)
      : body(b), pose(poseAt(b, from)), shape(shapeOf(b)) {
    pose.position -= foot;
    to_body = conjugate(pose.orientation);
  }
  Vec3 velocity(const Vec3& point) const { return velocityAt(body, pose, point); }
  Vec3 local(const Vec3& point) const { return rotate(to_body, Vec3(point - pose.position)); }
  physics::Bar local(const physics::Bar& bar) const {
    return {local(bar.base), rotate(to_body, bar.axis), bar.length, bar.base_radius,
            bar.tip_radius};
  }
};

/// One link and one body.
struct Pair {
  physics::Bar bar;                  ///< tree's frame
  Vec3 base_velocity, tip_velocity;  ///< relative to the body at the same point, tree's axes

  Pair(const ContactTree& tree, std::size_t link, const Placed& placed) {
    const Branch& b = tree.skeleton.branches[static_cast<std::size_t>(tree.branches[link])];
    const Pose& pose = tree.start.pose[link];
    bar = {pose.position, axisZ(pose.orientation), b.length, b.base_radius, b.tip_radius};
    const Vec3 &velocity = tree.start.velocity[link], &spin = tree.start.spin[link];
    base_velocity = velocity - placed.velocity(bar.base);
    tip_velocity =
        velocity + cross(spin, Vec3(bar.length * bar.axis)) - placed.velocity(bar.at(bar.length));
  }
  double fastest() const { return std::max(length(base_velocity), length(tip_velocity)); }
  /// A larger gap cannot close in a step of `h` seconds [m].
  double reach(double h) const { return SKIN + LOOK_AHEAD * h * fastest(); }
};

/// Returns a lower bound of the gap between a body and a bar: distance grows no faster than the
/// position along the bar.
inline double leastGap(const Placed& placed, const physics::Bar& bar) {
  Vec3 normal;
  const double half = 0.5 * bar.length;
  return signedDistance(placed.shape, placed.local(bar.at(half)), normal) - half - bar.base_radius;
}

}  // namespace vegetation_sim::forest
