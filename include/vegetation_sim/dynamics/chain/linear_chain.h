// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/dynamics/chain/chain.h"

namespace vegetation_sim::physics {

/// Small motion of a link: its turn about its joint and the displacement of that joint, world axes.
struct SmallMotion {
  Vec3 turn{Vec3::Zero()};  ///< [rad]
  Vec3 move{Vec3::Zero()};  ///< [m]
};

/// A chain linearised about rest, on the ground: M x'' + C x' + K x = f. A vector holds [links][2]
/// bends [rad] or joint torques [N m]. K and C are diagonal: springs and dampers of the joints. M
/// is the full chain's mass matrix and is never formed. Keeps scratch memory: one thread at a time.
class LinearChain {
 public:
  explicit LinearChain(const std::vector<Link>& links);

  std::size_t size() const { return 2 * links_.size(); }  ///< length of a vector
  /// Springs and dampers, two equal values per link [N m/rad], [N m s/rad].
  const std::vector<double>& stiffness() const { return stiffness_; }
  const std::vector<double>& damping() const { return damping_; }
  /// out = M x, by one pass to the tips and one back.
  void timesMass(const double* x, double* out);
  /// Returns the joint torques of wrenches [links] about the joints at rest.
  std::vector<double> torquesOf(const std::vector<Wrench>& wrenches) const;
  /// Computes the motion of every link for bends `x`.
  void motionOf(const double* x, std::vector<SmallMotion>& out) const;
  /// Returns the poses of the links at rest.
  const std::vector<Pose>& rest() const { return rest_; }

 private:
  // A link at rest, world axes.
  struct Node {
    int parent;
    Vec3 first, second;  // axes of the two bends
    Vec3 offset;         // from the parent's joint
    Vec3 moment;         // mass times centre
    Symmetric3 inertia;  // about the joint
    double mass;
  };
  std::vector<Node> links_;
  std::vector<Pose> rest_;
  std::vector<double> stiffness_, damping_;
  std::vector<SmallMotion> motion_;
  std::vector<Wrench> momentum_;
};

}  // namespace vegetation_sim::physics
