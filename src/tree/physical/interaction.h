// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/core/math/time.h"
#include "vegetation_sim/core/math/vectors.h"
#include "vegetation_sim/tree/physical/body.h"

namespace vegetation_sim::forest {

/// A point on a branch of a forest.
struct BranchPoint {
  std::uint32_t tree{0};
  int branch{0};
  double along{0.0};  ///< from the branch's base [m], 0 to its length
};

/// Holds a point of a branch to a target by a damped spring with a force limit. Between ticks the
/// target moves in a straight line, whose velocity the damper uses. A grab with a jaw has two
/// springs instead, of half the stiffness, damping and force limit, at the ends of the jaw.
struct Grab {
  BranchPoint point;
  Vec3 target{Vec3::Zero()};  ///< world [m]
  double stiffness{2000.0};   ///< [N/m]
  double damping{40.0};       ///< [N s/m]
  double force_limit{200.0};  ///< [N]
  std::string frame;          ///< tf frame of the body that holds; empty: a point of the world
  double lease{0.0};          ///< duration from the last renewal to its end; 0: unlimited [s]
  std::uint32_t id{0};        ///< 0 in a request: the forest assigns one
  Nanoseconds renewed{0};     ///< of the last renewal, set by the forest
  Vec3 offset{Vec3::Zero()};  ///< of the target in `frame` [m]
  Pose holder;                ///< world pose of `frame` when the target was last set
  double jaw_length{0.0};     ///< 0: holds a point; else also the branch's direction [m]
  /// Unit vector along the branch that a jaw keeps, in the axes of `frame`; without a frame, world.
  Vec3 direction{Vec3::UnitZ()};
};

/// A grab that is over.
struct EndedGrab : Grab {
  enum Reason : int { LEASE_EXPIRED = 0, BRANCH_BROKEN = 1 };
  Reason reason{LEASE_EXPIRED};
};

/// A request to cut a branch off at its joint, with all that it carries.
struct BranchCut {
  std::uint32_t tree{0};
  int branch{1};
};

/// The direction in which a jaw keeps the branch, in world axes.
inline Vec3 jawDirection(const Grab& grab) {
  return rotate(grab.holder.orientation, grab.direction);
}

/// A force on a branch during an interval. With `whole_tree` all branches of the tree are physical
/// meanwhile, as a calibration needs (paper 1).
struct Push {
  BranchPoint point;
  Vec3 force{Vec3::Zero()};  ///< world [N]
  Nanoseconds until{0};      ///< end of the interval
  Nanoseconds from{0};       ///< start; a stamp in the past means the last tick
  bool whole_tree{false};
};

/// Reaction of a branch on the body that holds or touches it.
struct Reaction {
  enum Kind : int { GRAB = 0, CONTACT = 1 };
  Kind kind{GRAB};
  std::uint32_t grab{0};      ///< id of the grab; 0: a contact
  std::string body;           ///< contact: Body::id
  std::string frame;          ///< Grab::frame or Body::frame
  Pose holder;                ///< grab with a frame: Grab::holder
  BranchPoint at;             ///< point on the branch
  Vec3 point{Vec3::Zero()};   ///< world [m]
  Vec3 force{Vec3::Zero()};   ///< on the body, world [N]
  Vec3 torque{Vec3::Zero()};  ///< on the body about `point`, world [N m]
  bool limited{false};        ///< the force is at its limit
  double penetration{0.0};    ///< contact: depth [m]
};

/// Adds a fault for each invalid number of a grab or a push; their branch points are checked by
/// ForestPhysics.
void check(const Grab& grab, Faults& faults);
void check(const Push& push, Faults& faults);
/// Adds a fault unless the norm of `q` is 1 up to 0.001.
void checkOrientation(const Quat& q, const std::string& name, Faults& faults);
/// Adds a fault for each invalid number of the pose of a grab's holder.
void checkHolder(const Pose& holder, Faults& faults);

/// Current cost of the physics.
struct PhysicsFigures {
  std::size_t trees{0};          ///< with physical branches
  std::size_t branches{0};       ///< physical, including those that blend back
  std::size_t blending{0};       ///< of these, blending back
  std::size_t bytes{0};          ///< used by them and by cached trees near bodies
  std::size_t steps{0};          ///< taken at the last tick
  std::size_t refused{0};        ///< branches that loads need and the cap keeps procedural
  std::size_t capped_forces{0};  ///< grabs and contacts at their limit
  std::size_t replaced{0};  ///< tree steps of the last tick that midpoint took because an explicit
                            ///< integrator was beyond its bound
  std::size_t coarse{0};    ///< tree steps whose contacts needed more bisections than allowed
  std::size_t skipped{0};   ///< gaps in time that were not stepped through
  std::size_t broken{0};    ///< branches that have come off
  std::size_t unbroken{0};  ///< trees whose overloaded wood stays, since too many have come off
};

}  // namespace vegetation_sim::forest
