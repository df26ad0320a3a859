// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "vegetation_sim/tree/modal/modal_tree.h"
#include "vegetation_sim/tree/motion/batch_poser.h"
#include "vegetation_sim/tree/motion/motion_level.h"

namespace vegetation_sim::forest {

/// What the air does to a tree in modes at one moment.
struct ModalLoad {
  std::vector<double> force;  ///< [modes] on the tree at rest
  Vec3 air{Vec3::Zero()};     ///< ModalTree::airOn(), by which levers turn [m/s]
};

/// A tree that sways in its modes (N13). Amplitudes and rates at the last tick are all that is
/// remembered: the modes follow from the seed, their loads from the wind law. A value; copies share
/// the modes.
class ModalTreeState {
 public:
  explicit ModalTreeState(std::shared_ptr<const ModalTree> modes);

  const ModalTree& modes() const { return *modes_; }
  /// In fine modes, or in all that the tree has.
  bool fine() const;
  const physics::ModalState& state() const { return state_; }  ///< at stamp()
  Nanoseconds stamp() const { return stamp_; }
  /// Of the modes, their fast copy and what is kept of the waves that blow.
  std::size_t bytes() const { return modes_->bytes() + batch_->bytes() + air_.bytes(); }

  void loadOf(const wind::Instant& wind, ModalLoad& out);
  /// Modal forces [modes] of a load on the tree as it is bent.
  void addLeverForces(const ModalLoad& load, const std::vector<double>& amplitude,
                      std::vector<double>& out);
  /// Starts as the procedural motion is under loads `step` seconds before the stamp, at it, and
  /// after.
  void begin(const std::array<ModalLoad, 3>& loads, double step, Nanoseconds stamp);
  /// Goes on from a state, under a load. @throws InvalidInput if it has not as many modes.
  void restore(const physics::ModalState& state, const ModalLoad& load, Nanoseconds stamp);
  /// Equal steps to `stamp` between loads [steps + 1].
  void step(const std::vector<ModalLoad>& loads, Nanoseconds stamp);

  /// Amplitudes at a stamp near the last tick: by their rates and accelerations there, not farther
  /// than LONGEST_LOOK_AHEAD.
  std::vector<double> amplitudeAt(Nanoseconds stamp) const;
  /// Poses all branches in single precision, as displays do while the modes have all the weight.
  void pose(const BatchPoser& poser, Nanoseconds stamp, BatchPoses& out) const;
  /// Amplitudes between the last two ticks, as a cubic that has their values and rates.
  void interpolateAmplitude(Nanoseconds stamp, std::vector<double>& out) const;

 private:
  void finishStep(const ModalLoad& load, Nanoseconds stamp);

  std::shared_ptr<const ModalTree> modes_;
  std::shared_ptr<const physics::BatchModes> batch_;  // of modes_
  physics::ModalStepper stepper_;
  physics::ModalState state_, before_;  // at the last tick, at the one before
  std::vector<double> acceleration_;
  ModalAir air_;               // follows from the wind
  physics::ModalState trial_;  // scratch
  std::vector<double> before_load_, after_load_;
  Nanoseconds stamp_{0}, before_stamp_{0};
};

/// Deviation of each joint: procedural, or modal, or between them, as the weights say. `wind` is
/// relative to the foot; `modal_state`: none, all procedural.
std::vector<JointAngles> modalAngles(const Tree& tree, const wind::Instant& wind,
                                     const Weights& weights, const ModalTreeState* modal_state,
                                     Nanoseconds stamp);

/// Bends of one joint in the modes, within what joints do.
JointAngles bendOf(const ModalTree& modes, const std::vector<double>& amplitude, int branch);
/// `weight` of the way from one to the other.
JointAngles interpolate(const JointAngles& from, const JointAngles& to, double weight);

}  // namespace vegetation_sim::forest
