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

/// A box around the links of a tree at the start of a step, with their largest speed. Bodies far
/// from it need no test with each link.
class LinkBounds {
 public:
  explicit LinkBounds(const ContactTree& tree) {
    for (std::size_t i = 0; i < tree.branches.size(); ++i) {
      const Branch& b = tree.skeleton.branches[static_cast<std::size_t>(tree.branches[i])];
      const Pose& pose = tree.start.pose[i];
      const Vec3 tip = pose.position + b.length * axisZ(pose.orientation);
      low_ = low_.cwiseMin(pose.position).cwiseMin(tip);
      high_ = high_.cwiseMax(pose.position).cwiseMax(tip);
      thickest_ = std::max(thickest_, b.base_radius);
      fastest_ = std::max(fastest_,
                          length(tree.start.velocity[i]) + b.length * length(tree.start.spin[i]));
    }
  }
  /// Returns true if no Pair of the body can be within its reach in a step of `h` seconds.
  bool isFar(const Placed& placed, double h) const {
    const Vec3& centre = placed.pose.position;
    const double least = length(Vec3(centre - centre.cwiseMax(low_).cwiseMin(high_)));
    const double most =
        length(Vec3((centre - low_).cwiseAbs().cwiseMax((high_ - centre).cwiseAbs())));
    const double speed = fastest_ + length(placed.body.velocity) + most * length(placed.body.spin);
    return least > ROOM * (placed.shape.reach() + thickest_ + SKIN + LOOK_AHEAD * h * speed);
  }

 private:
  static constexpr double FARTHEST = 1e9, ROOM = 1.001;  // [m], for rounding
  Vec3 low_{Vec3::Constant(FARTHEST)}, high_{Vec3::Constant(-FARTHEST)};
  double thickest_{0.0}, fastest_{0.0};
};

/// Returns a lower bound of the gap between a body and a bar: distance grows no faster than the
/// position along the bar.
inline double leastGap(const Placed& placed, const physics::Bar& bar) {
  Vec3 normal;
  const double half = 0.5 * bar.length;
  return signedDistance(placed.shape, placed.local(bar.at(half)), normal) - half - bar.base_radius;
}

}  // namespace vegetation_sim::forest
