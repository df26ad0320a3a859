// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/chain/articulated.h"

namespace vegetation_sim::physics {

/// Selects which equations of paper 1 are used as they are printed (section 4.2).
struct PaperForm {
  /// reaction of children: the second bend's torque with the wrong sign (E2)
  bool reaction{false};
  bool parent{false};  ///< parents turn by their net torque, not as their joints allow (E11)
  bool mass{false};    ///< J = m I: mass times 1 m^2 instead of the bar's inertia (E13)
};

/// The simplified dynamics of paper 1: every link turns by the net torque on it alone, J Omega' =
/// tau with the same J about all axes. A child passes its joint's torque to its parent and never a
/// force, so there is no lever arm. Used for comparison with the full chain; the interface is that
/// of ArticulatedBody.
class PaperBody {
 public:
  explicit PaperBody(PaperForm form = {}) : form_(form) {}

  /// Computes the accelerations of all joints [rad/s^2]: the net torque, less what the parent does,
  /// along the link's own x and y (S1-32). The implicit part is eliminated along the tree, O(N).
  void accelerations(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                     const ChainState& state, const Kinematics& kinematics, const Loads& loads,
                     const Implicitness& implicitness, std::vector<Vec2>& out);

  /// Returns the net torques of the last accelerations(), per link: loads, own joint and reaction
  /// of the children, without the implicit part (S1-31) [N m].
  const std::vector<Vec3>& netTorques() const { return net_; }

 private:
  struct Matrix {
    Vec3 x{Vec3::Zero()}, y{Vec3::Zero()}, z{Vec3::Zero()};  // rows
  };
  struct Node {
    Vec3 first, second;   // axes, world
    double k{0.0};        // implicit stiffness of the joint
    Matrix inertia;       // of the link, of anchors, and the contribution of children
    Vec3 predicted;       // implicit torque of the children
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

/// Returns J of a link: its inertia across, about its joint, or its mass times 1 m^2 [kg m^2].
double paperInertia(const Link& link, PaperForm form);

}  // namespace vegetation_sim::physics
