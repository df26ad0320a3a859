// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "dynamics/batch_step/chain_sweep.h"
#include "dynamics/contact/contact_stepper.h"
#include "dynamics/integration/integrator.h"
#include "tree/physical/procedural_motion.h"

namespace vegetation_sim::forest {

/// The angles of a joint as the coordinates of a link.
inline physics::Vec2 vectorOf(const JointAngles& angles) {
  return {angles.first, angles.second};
}

/// Wind on a tree, its level, and its modal state if it has one.
struct TreeWind {
  const wind::Field& field;
  LevelState level;
  const MotionLaw& law;
  const ModalTreeState* modal_state{nullptr};
};

/// The wind windows of the last few stamps: the trees of a forest step through the same stamps.
class WindWindows {
 public:
  /// Forgets all windows, because the wind may have changed.
  void clear() { used_ = 0; }
  /// Returns the window of a stamp; it stays valid until HELD other stamps were asked for.
  const WindWindow& at(const wind::Field& field, Nanoseconds stamp) {
    for (std::size_t i = 0; i < std::min(used_, HELD); ++i)
      if (windows_[i].stamp() == stamp) return windows_[i];
    WindWindow& out = windows_[used_++ % HELD];
    out.sampleAt(field, stamp);
    return out;
  }

 private:
  static constexpr std::size_t HELD = 16;
  std::array<WindWindow, HELD> windows_;
  std::size_t used_{0};
};

/// Scratch memory of steps; its content between steps does not matter. One instance serves all
/// trees of a forest, so that a step does not allocate.
struct SubtreeScratch {
  WindWindows windows;
  ModalSamples modal;
  WindSampler air;
  std::vector<Vec3> arms;     // from joints to centres of drag
  ProceduralMotions motions;  // of links
  ProceduralMotions carrier_motions;
  physics::ChainStepper stepper;
  physics::ChainScratch chain;
  physics::ArticulatedBody body;
  std::vector<Pose> carrier_poses;
  std::vector<CarrierMotion> carriers;
  std::vector<physics::BaseMotion> bases;
  physics::ChainState procedural;
  std::vector<physics::Vec2> acceleration, torque;
  physics::Kinematics kinematics;
  physics::Loads loads;
  physics::ContactStepper contact_stepper;
  physics::Kinematics start;        // of a step with contacts
  std::vector<Vec3> places;         // of points that springs hold
  std::vector<std::size_t> loaded;  // links
  // Demotion uses these: links that wait for calm motion and their branches; flags of all links;
  // positions at rest and the wind there.
  std::vector<std::size_t> waiting;
  std::vector<int> branches;
  std::vector<char> calm, bears;
  physics::Rows rest, rest_air;

  std::size_t replaced{0};  ///< tree steps that another integrator had to take

  const WindWindow& sampleAt(const wind::Field& field, Nanoseconds stamp) {
    return windows.at(field, stamp);
  }
  /// Returns the motion of the parts of a tree that are not physical.
  ProceduralMotion motionOf(const Tree& tree, const TreeWind& around, Nanoseconds stamp) {
    if (around.modal_state) modal.sampleAt(*around.modal_state, stamp);
    return {tree, sampleAt(around.field, stamp), around.level, around.law,
            around.modal_state ? &modal : nullptr};
  }
};

}  // namespace vegetation_sim::forest
