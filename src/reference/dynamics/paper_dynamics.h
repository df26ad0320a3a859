// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/chain/articulated.h"

namespace vegetation_sim::physics {

/// Which of paper 1's equations are taken as they are printed (section 4.2).
struct PaperForm {
  bool reaction{false};  ///< of children: the second bend's torque with the wrong sign (E2)
  bool parent{false};    ///< parents turn as their net torque says, not as their joints let (E11)
  bool mass{false};      ///< J = m I: mass times 1 m^2 instead of the bar's inertia (E13)
};

/// Paper 1's simplified dynamics: every link turns by the net torque on it alone, J Omega' = tau
/// with the same J about all axes; a child passes its joint's torque to its parent and never a
/// force, so there is no lever arm. Charted beside the full chain; use as ArticulatedBody.
class PaperBody {
 public:
  explicit PaperBody(PaperForm form = {}) : form_(form) {}

  /// Accelerations of all joints [rad/s^2]: the net torque, less what the parent does, along the
  /// link's own x and y (S1-32). The implicit part is eliminated along the tree, O(N).
  void accelerations(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                     const ChainState& state, const Kinematics& kinematics, const Loads& loads,
                     const Implicitness& implicitness, std::vector<Vec2>& out);

  /// Of the last accelerations(), per link: loads, own joint, children's reaction; without what
  /// was foreseen (S1-31) [N m].
  const std::vector<Vec3>& netTorques() const { return net_; }

 private:
  struct Matrix {
    Vec3 x{Vec3::Zero()}, y{Vec3::Zero()}, z{Vec3::Zero()};  // rows
  };
  struct Node {
    Vec3 first, second;   // axes, world
    double k{0.0};        // foreseen stiffness of the joint
    Matrix inertia;       // own, anchors' and what children give back
    Vec3 predicted;       // torque of the children, foreseen
    double g1, g2;        // acceleration = g - G parent
    Vec3 row1, row2;      // of G
    Vec3 free, by1, by2;  // own turn: free - k (by1 a1 + by2 a2), as printed
  };
  void gather(const std::vector<Link>& links, const ChainState& state, const Kinematics& kinematics,
              const Loads& loads, const Implicitness& implicitness);
  void solve(Node& node, const Vec3& torque) const;
  void passOn(const Node& node, Node& parent) const;

  PaperForm form_;
  std::vector<Vec3> net_, turn_;
  std::vector<Node> nodes_;
};

/// The J of a link: its inertia across, about its joint, or its mass times 1 m^2 [kg m^2].
double paperInertia(const Link& link, PaperForm form);

}  // namespace vegetation_sim::physics
