// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "dynamics/chain/bend.h"
#include "vegetation_sim/dynamics/chain/chain.h"

namespace vegetation_sim::physics {

/// Computes poses, spins and velocities of all links. Empty `bases` mean the ground at rest.
void kinematicsOf(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                  const ChainState& state, Kinematics& out);

/// Linear and angular momentum, the latter about the world's origin [kg m/s], [kg m^2/s].
struct Momentum {
  Vec3 linear{Vec3::Zero()}, angular{Vec3::Zero()};
};
Momentum momentumOf(const std::vector<Link>& links, const Kinematics& kinematics);

/// Returns the kinetic energy plus that of the springs [J].
double energyOf(const std::vector<Link>& links, const ChainState& state,
                const Kinematics& kinematics);

/// The implicit terms of a step: springs act with `stiffness` times their k and dampers with
/// `damping` times their nu against the unknown acceleration [s^2], [s]. `products` is the factor
/// of velocity products (centrifugal, gyroscopic): 1, or 0 in motion too fast for them. `ease`
/// reduces the implicit stiffness, as far as the joint's guaranteed inertia covers it [s^2].
struct Implicitness {
  double stiffness{0.0}, damping{0.0};
  double products{1.0};
  double ease{0.0};

  /// Returns what a joint's springs and dampers add to its inertia [kg m^2].
  double predicted(const Link& link) const {
    return stiffness * link.stiffness + damping * link.damping -
           std::min(ease * link.stiffness, link.guaranteed_inertia);
  }
};

/// Returns the implicit terms of a theta step: theta = 1 is backward Euler. Below it springs are
/// eased, so that slow motion keeps its period to fourth order at theta = 1/2.
inline Implicitness implicitFor(double theta, double h, double products) {
  return {theta * theta * h * h, theta * h, products, (1.0 - theta) * h * h / 3.0};
}

/// The full articulated chain: inertia, reaction forces, gyroscopic terms and lever arms by the
/// articulated-body algorithm, O(N), for bends below pi. The plain double version is the reference
/// of any faster one. Keeps its scratch memory, so that a step allocates nothing once it has run.
class ArticulatedBody {
 public:
  /// Computes kinematicsOf and keeps what solve() needs of it.
  void updateKinematics(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                        const ChainState& state, Kinematics& out);
  /// Computes the accelerations of all joints [rad/s^2] for the last kinematics.
  void solve(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
             const ChainState& state, const Kinematics& kinematics, const Loads& loads,
             const Implicitness& implicitness, std::vector<Vec2>& out);
  /// Does both for callers that have `kinematics`, kinematicsOf(state), already.
  void accelerations(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                     const ChainState& state, const Kinematics& kinematics, const Loads& loads,
                     const Implicitness& implicitness, std::vector<Vec2>& out);

  /// Must follow accelerations() or solve(), with its `out`. Replaces the accelerations by those of
  /// the mean of the velocity products at `state.rate` and at `state.rate + h out`, in the same
  /// pose.
  void averageProducts(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                       const ChainState& state, const Kinematics& kinematics, double h,
                       std::vector<Vec2>& out);

  /// Inverse dynamics: computes the joint torques besides spring and damper that give
  /// `acceleration` [N m].
  void torques(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
               const ChainState& state, const Kinematics& kinematics, const Loads& loads,
               const std::vector<Vec2>& acceleration, std::vector<Vec2>& out);

  /// Returns whether all inertias that the last accelerations() divided by were positive.
  bool positive() const { return positive_; }

  /// A joint in world axes.
  struct Joint {
    Vec3 first, second;  // axes of the two bends
    Vec3 offset;         // from the parent's joint or the base to the joint
    Axes axes;           // of the link
    Vec3 sweep;          // velocity of the link's z axis [1/s]
    Bend bend;
  };
  /// Returns the joints of the last kinematics, accelerations() or torques(), per link.
  const std::vector<Joint>& joints() const { return joints_; }

  /// Articulated inertia and bias: torque = a alpha + b acc + torque, force = b^T alpha + m acc +
  /// force, about the joint.
  struct Body {
    Symmetric3 a, m;
    Vec3 bx, by, bz;  // rows of b
    Vec3 torque, force;
  };
  /// Acceleration of the spin and of the joint.
  struct Acceleration {
    Vec3 spin, linear;
  };
  /// Acceleration that a link has if no joint accelerates, that of its z axis included.
  struct FreeMotion {
    Vec3 spin, linear, axis;
  };

 private:
  // The joint's two freedoms, eliminated one after the other: inertia times axes; that of the
  // second excludes what the first takes.
  struct Gain {
    Vec3 a1, a2, b1, b2;
    double inverse1, inverse2, coupling;
    double drive1, drive2;
  };
  using Links = std::vector<Link>;
  using Bases = std::vector<BaseMotion>;

  void turnOut(const Links& links, const Bases& bases, const ChainState& state,
               const Kinematics& kinematics);
  void sweepOut(const Links& links, const Bases& bases, const ChainState& state,
                const Kinematics& kinematics, double products);
  void addLoads(const Loads& loads, const Implicitness& implicitness);
  void sweepBack(const Links& links, const ChainState& state, const Loads& loads,
                 const Implicitness& implicitness);
  void sweepWrenches(const Links& links);
  void settle(const Links& links, std::vector<Vec2>& out);

  std::vector<Joint> joints_;
  std::vector<Body> bodies_;
  std::vector<Gain> gains_;
  std::vector<FreeMotion> free_;
  std::vector<Acceleration> push_;  // added by joints
  std::vector<Wrench> bias_;        // of the link alone
  std::vector<Vec2> change_;
  bool positive_{true};
};

}  // namespace vegetation_sim::physics
