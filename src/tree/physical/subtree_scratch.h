// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/contact/contact.h"
#include "dynamics/integration/integrator.h"
#include "tree/physical/procedural_motion.h"

namespace vegetation_sim::forest {

/// The air around a tree, as its level tells it, and its modes where it sways in them.
struct TreeWind {
  const wind::Field& field;
  LevelState level;
  const MotionLaw& law;
  const ModalTreeState* modal_state{nullptr};
};

/// Memory that stepping needs and nothing else: what is in it between steps does not matter. One
/// serves all the trees of a forest, so that a step allocates nothing.
struct SubtreeScratch {
  WindWindow window;
  ModalSamples modal;
  WindSampler air;
  std::vector<Vec3> arms;     // from joints to where the air grips
  ProceduralMotions motions;  // of links
  ProceduralMotions carrier_motions;
  physics::ChainStepper stepper;
  physics::ArticulatedBody body;
  std::vector<Pose> carrier_poses;
  std::vector<CarrierMotion> carriers;
  std::vector<physics::BaseMotion> bases;
  physics::ChainState procedural;
  std::vector<physics::Vec2> acceleration, torque;
  physics::Kinematics kinematics;
  physics::Loads loads;
  physics::ContactStepper contact_stepper;
  physics::Kinematics start;  // of a step with contacts
  std::vector<Vec3> places;   // of points that springs hold

  std::size_t replaced{0};  ///< steps of a tree that another integrator had to take

  /// Looks at a stamp, unless that is where it looks already.
  const WindWindow& sampleAt(const wind::Field& field, Nanoseconds stamp) {
    if (window.stamp() != stamp) window.sampleAt(field, stamp);
    return window;
  }
  /// The motion of a tree around a stamp, where it is not physical.
  ProceduralMotion motionOf(const Tree& tree, const TreeWind& around, Nanoseconds stamp) {
    if (around.modal_state) modal.sampleAt(*around.modal_state, stamp);
    return {tree, sampleAt(around.field, stamp), around.level, around.law,
            around.modal_state ? &modal : nullptr};
  }
};

}  // namespace vegetation_sim::forest
