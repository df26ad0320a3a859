// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::physics {

using Vec2 = Eigen::Vector2d;  // storage; arithmetic on it is written out

/// A symmetric 3 x 3 matrix.
struct Symmetric3 {
  double xx{0.0}, yy{0.0}, zz{0.0}, xy{0.0}, xz{0.0}, yz{0.0};
};

/// A joint with two bends about its own rest x and y axes (a rotation vector), and the rigid body
/// that it turns: one piece of wood, or several as one.
struct Link {
  int parent{-1};      ///< index, lower than the own one; -1: the link hangs on `base`
  int base{0};         ///< index of a BaseMotion, for links without parent
  double h{0.0};       ///< position of the joint along the z axis of its parent or base [m]
  Quat rest{};         ///< rest rotation in the axes of the parent or base
  double length{1.0};  ///< along the link's own z axis [m]
  double mass{1.0};    ///< [kg]
  Vec3 centre{Vec3(0.0, 0.0, 0.5)};  ///< centre of mass, from the joint, own axes [m]
  Symmetric3 inertia{1.0, 1.0, 0.0, 0.0, 0.0, 0.0};  ///< about the joint, own axes [kg m^2]
  double stiffness{1.0};                             ///< of both bends [N m/rad]
  double damping{0.0};                               ///< [N m s/rad]
  double guaranteed_inertia{0.0};  ///< see shareInertia; 0 is safe and less exact [kg m^2]
};

/// Returns whether the link is a round bar with its centre on its axis, which is the usual case.
inline bool isBar(const Link& link) {
  const Symmetric3& i = link.inertia;
  return link.centre.x() == 0.0 && link.centre.y() == 0.0 && i.xx == i.yy && i.xy == 0.0 &&
         i.xz == 0.0 && i.yz == 0.0;
}

/// Prescribed motion of a body that carries links and is not simulated itself: the pose of its
/// joint and how it moves, world axes. Default: the ground at the origin.
struct BaseMotion {
  Pose pose;
  Vec3 spin{Vec3::Zero()};          ///< [rad/s]
  Vec3 velocity{Vec3::Zero()};      ///< of the joint [m/s]
  Vec3 spin_rate{Vec3::Zero()};     ///< [rad/s^2]
  Vec3 acceleration{Vec3::Zero()};  ///< of the joint [m/s^2]
};

/// Bends and their rates, per link [rad], [rad/s].
struct ChainState {
  std::vector<Vec2> q, rate;
};

/// Poses and velocities of the links, world axes.
struct Kinematics {
  std::vector<Pose> pose;      ///< of the joint; z along the link
  std::vector<Vec3> spin;      ///< [rad/s]
  std::vector<Vec3> velocity;  ///< of the joint [m/s]
};

/// An external load on a link about its joint, world axes [N], [N m].
struct Wrench {
  Vec3 force{Vec3::Zero()}, torque{Vec3::Zero()};
};

/// A stiff damped spring on a point of a link. `force` is the force of spring and damper in the
/// given kinematics; the other fields let an implicit step predict how the force changes.
struct Anchor {
  int link{0};
  Vec3 arm{Vec3::Zero()};    ///< from the joint to the point, world axes [m]
  Vec3 force{Vec3::Zero()};  ///< on the link, world [N]
  Symmetric3 stiffness;      ///< world axes [N/m]
  Symmetric3 damping;        ///< world axes [N s/m]
};

/// How the force in a link's wrench falls as a point of the link gains speed: by `all` times the
/// gain and `along` times its part along `along`. An implicit step uses it to predict the force;
/// other steps ignore it.
struct Drag {
  Vec3 arm{Vec3::Zero()};    ///< from the joint to the point, world axes [m]
  double all{0.0};           ///< [N s/m]
  Vec3 along{Vec3::Zero()};  ///< world axes [sqrt(N s/m)]
};

/// All loads on a chain at one time.
struct Loads {
  std::vector<Wrench> wrench;      ///< per link
  std::vector<Vec2> joint_torque;  ///< per link, in addition to spring and damper [N m]
  std::vector<Anchor> anchors;
  std::vector<Drag> drag;  ///< per link, or empty

  /// Sets no load on any of `links` links; keeps memory.
  void clear(std::size_t links) {
    wrench.assign(links, Wrench());
    joint_torque.assign(links, Vec2::Zero());
    anchors.clear();
    drag.clear();
  }
};

/// The environment of a chain. Either function may be empty: ground at rest, no load.
struct Surroundings {
  std::function<void(double time, std::vector<BaseMotion>& bases)> bases;
  std::function<void(const Kinematics& kinematics, double time, Loads& loads)> loads;
};

}  // namespace vegetation_sim::physics
