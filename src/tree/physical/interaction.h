// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/core/math/time.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::forest {

/// A place on the wood of a forest.
struct BranchPoint {
  std::uint32_t tree{0};
  int branch{0};
  double along{0.0};  ///< from the branch's base [m], 0 to its length
};

/// Holds a point of a branch to a target by a damped spring whose force is limited. Between ticks
/// the target moves in a straight line, so the spring's damper knows its velocity.
struct Grab {
  BranchPoint point;
  Vec3 target{Vec3::Zero()};  ///< world [m]
  double stiffness{2000.0};   ///< [N/m]
  double damping{40.0};       ///< [N s/m]
  double force_limit{200.0};  ///< [N]
  std::string frame;          ///< tf frame of the body that holds; empty: a point of the world
  double lease{0.0};          ///< ends this long after it was last moved or renewed; 0: never [s]
  std::uint32_t id{0};        ///< 0 when it is added: the forest gives one
  Nanoseconds renewed{0};     ///< kept by the forest
  Vec3 offset{Vec3::Zero()};  ///< of the target in `frame` [m]
  Pose holder;                ///< world pose of `frame` when the target was last set
};

/// A force on a branch for a while.
struct Push {
  BranchPoint point;
  Vec3 force{Vec3::Zero()};  ///< world [N]
  Nanoseconds until{0};      ///< the force acts up to here
  Nanoseconds from{0};       ///< and from here on; in the past: from the last tick on
};

enum class Shape : int { SPHERE = 0, CAPSULE = 1, BOX = 2 };

/// A body of a robot that pushes branches aside.
struct Body {
  std::string id;     ///< reactions are told in the body's frame under this name
  std::string frame;  ///< of tf that it is tied to
  int shape{0};       ///< Shape
  /// Sphere: radius, -, -. Capsule along the own z: radius, -, length between the centres of its
  /// caps. Box: edges. [m]
  Vec3 size{Vec3(0.05, 0.0, 0.0)};
  Pose pose;                    ///< world, at `stamp`
  Vec3 velocity{Vec3::Zero()};  ///< of the pose's origin, world [m/s]
  Vec3 spin{Vec3::Zero()};      ///< world [rad/s]
  Nanoseconds stamp{0};
  Pose in_frame;  ///< of the body in its frame
};

/// What a branch does to the body that holds or touches it.
struct Reaction {
  enum Kind : int { GRAB = 0, CONTACT = 1 };
  Kind kind{GRAB};
  std::uint32_t grab{0};      ///< id of the grab; 0: a contact
  std::string body;           ///< contact: Body::id
  std::string frame;          ///< Grab::frame or Body::frame
  Pose holder;                ///< grab with a frame: Grab::holder
  BranchPoint at;             ///< where on the branch
  Vec3 point{Vec3::Zero()};   ///< world [m]
  Vec3 force{Vec3::Zero()};   ///< on the body, world [N]
  Vec3 torque{Vec3::Zero()};  ///< on the body about `point`, world [N m]
  bool limited{false};        ///< the force is at its limit
  double penetration{0.0};    ///< contact: depth [m]
};

/// Adds a fault for whatever is wrong with the numbers of a grab or a push; the place on the tree
/// is for checkPoint.
void check(const Grab& grab, Faults& faults);
void check(const Push& push, Faults& faults);

/// What physics takes at the moment.
struct PhysicsFigures {
  std::size_t trees{0};          ///< with physical branches
  std::size_t branches{0};       ///< physical, those that blend back included
  std::size_t blending{0};       ///< of these, on their way back
  std::size_t bytes{0};          ///< held for them, and for trees that bodies are near to
  std::size_t steps{0};          ///< taken at the last tick
  std::size_t refused{0};        ///< branches that loads want and the cap leaves procedural
  std::size_t capped_forces{0};  ///< grabs and contacts at their limit
  std::size_t replaced{0};  ///< steps of a tree at the last tick, beyond the bound of an explicit
                            ///< integrator, that midpoint took
  std::size_t coarse{0};    ///< steps of trees whose contacts wanted more halvings than there are
  std::size_t skipped{0};   ///< gaps in time that were not stepped through
};

}  // namespace vegetation_sim::forest
