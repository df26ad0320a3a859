// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/physics/chain.h"

namespace vegetation_sim::physics {

/// Poses, spins and velocities of all links. `bases` empty: the ground at rest.
void kinematicsOf(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                  const ChainState& state, Kinematics& out);

/// Linear and angular momentum, the latter about the world's origin [kg m/s], [kg m^2/s].
struct Momentum {
  Vec3 linear{Vec3::Zero()}, angular{Vec3::Zero()};
};
Momentum momentumOf(const std::vector<Link>& links, const Kinematics& kinematics);

/// Kinetic energy and that of the springs [J].
double energyOf(const std::vector<Link>& links, const ChainState& state,
                const Kinematics& kinematics);

/// What an implicit step foresees: springs act with `stiffness` times their k and dampers with
/// `damping` times their nu against the acceleration that is sought [s^2], [s]. `products`: what
/// part of the velocity products (centrifugal, gyroscopic) is felt: 1, or 0 in motion too wild.
struct Implicitness {
  double stiffness{0.0}, damping{0.0};
  double products{1.0};
};

/// The full articulated chain: inertia, reaction forces, gyroscopic terms, lever arms, by the
/// articulated-body algorithm, O(N), for bends below pi. Plain double version: the reference of any
/// faster one. Keeps its scratch, so that a step allocates nothing once it has run.
class ArticulatedBody {
 public:
  /// Accelerations of all joints [rad/s^2]. `kinematics` is kinematicsOf(state).
  void accelerations(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                     const ChainState& state, const Kinematics& kinematics, const Loads& loads,
                     const Implicitness& implicitness, std::vector<Vec2>& out);

  /// Inverse dynamics: the joint torques besides spring and damper that give `acceleration`
  /// [N m].
  void torques(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
               const ChainState& state, const Kinematics& kinematics, const Loads& loads,
               const std::vector<Vec2>& acceleration, std::vector<Vec2>& out);

  /// Of a joint in world axes, and what its motion adds to accelerations by itself.
  struct Joint {
    Vec3 first, second;  // axes of the two bends
    Vec3 offset;         // from what it hangs on to the joint
    Vec3 spin_bias, linear_bias;
  };
  /// Of the last accelerations() or torques(), per link.
  const std::vector<Joint>& joints() const { return joints_; }

  /// Articulated inertia and bias: torque = a alpha + b acc + torque, force = b^T alpha + m acc +
  /// force, about the joint.
  struct Body {
    Symmetric3 a, m;
    Vec3 bx, by, bz;  // rows of b
    Vec3 torque, force;
  };

 private:
  struct Gain {
    Vec3 a1, a2, b1, b2;   // inertia times axes
    double i11, i12, i22;  // inverse of the joint-space inertia
    double torque1, torque2;
  };
  void sweepOut(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                const ChainState& state, const Kinematics& kinematics, const Loads& loads,
                double products);
  void foreseeAnchors(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                      const Loads& loads, const Implicitness& implicitness);
  void sweepBack(const std::vector<Link>& links, const ChainState& state, const Loads& loads,
                 const Implicitness& implicitness);

  std::vector<Joint> joints_;
  std::vector<Body> bodies_;
  std::vector<Gain> gains_;
  std::vector<Vec3> spin_rate_, acceleration_;
};

}  // namespace vegetation_sim::physics
