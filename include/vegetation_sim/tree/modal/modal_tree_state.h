// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "vegetation_sim/tree/modal/modal_tree.h"
#include "vegetation_sim/tree/motion/batch_poser.h"
#include "vegetation_sim/tree/motion/motion_level.h"

namespace vegetation_sim {
class Archive;
}

namespace vegetation_sim::forest {

/// Wind load of a modal tree at one moment.
struct ModalLoad {
  std::vector<double> force;  ///< [modes] modal forces on the tree at rest
  Vec3 air{Vec3::Zero()};     ///< ModalTree::airOn() [m/s]
  /// Velocities of the wind at the coarse points, for quadratic drag only [m/s].
  std::vector<Vec3> velocity;
};

/// Amplitudes of all modes with their first and second derivatives in time.
struct ModalMotion {
  std::vector<double> amplitude, rate, acceleration;
};

/// Modal state of a tree (N13): amplitudes and rates at the last tick. Modes follow from the seed,
/// loads from the wind law. A value; copies share the modes.
class ModalTreeState {
 public:
  explicit ModalTreeState(std::shared_ptr<const ModalTree> modes);

  const ModalTree& modes() const { return *modes_; }
  /// Returns true if the tree has its fine modes, or all modes.
  bool fine() const;
  const physics::ModalState& state() const { return state_; }  ///< at stamp()
  Nanoseconds stamp() const { return stamp_; }
  /// Memory of the modes, their vectorised copy and the cached waves.
  std::size_t bytes() const { return modes_->bytes() + batch_->bytes() + air_.bytes(); }

  void loadOf(const wind::Instant& wind, ModalLoad& out);
  /// Computes the modal forces [modes] of a load on the bent tree.
  void addLeverForces(const ModalLoad& load, const physics::ModalState& state,
                      std::vector<double>& out);
  /// Starts at the procedural motion under the loads `step` seconds before the stamp, at the stamp
  /// and after it.
  void begin(const std::array<ModalLoad, 3>& loads, double step, Nanoseconds stamp);
  /// Continues from a state under a load. @throws InvalidInput for another number of modes.
  void restore(const physics::ModalState& state, const ModalLoad& load, Nanoseconds stamp);
  /// Takes equal steps to `stamp` between the loads [steps + 1].
  void step(const std::vector<ModalLoad>& loads, Nanoseconds stamp);
  /// Writes or reads all that the future depends on besides the modes. @throws InvalidInput for the
  /// state of another number of modes.
  void archive(Archive& a);

  /// Returns amplitudes at a stamp near the last tick, extrapolated by rates and accelerations over
  /// at most LONGEST_LOOK_AHEAD.
  std::vector<double> amplitudeAt(Nanoseconds stamp) const;
  /// Poses all branches in single precision, for displays while the modes have all the weight.
  void pose(const BatchPoser& poser, Nanoseconds stamp, BatchPoses& out) const;
  /// Interpolates the motion between the last two ticks by a cubic with their values and rates.
  void interpolateMotion(Nanoseconds stamp, ModalMotion& out) const;

 private:
  void stepOnce(const ModalLoad& from, const ModalLoad& to, double h);
  void finishStep(const ModalLoad& load, Nanoseconds stamp);

  std::shared_ptr<const ModalTree> modes_;
  std::shared_ptr<const physics::BatchModes> batch_;  // of modes_
  physics::ModalStepper stepper_;
  physics::ModalState state_, before_;  // at the last tick and at the one before
  std::vector<double> acceleration_;
  ModalAir air_;               // cache that follows from the wind
  physics::ModalState trial_;  // scratch
  std::vector<double> before_load_, after_load_;
  std::vector<double> damping_;  // scratch, for quadratic drag
  Nanoseconds stamp_{0}, before_stamp_{0};
};

/// Returns the deviation of each joint: procedural, modal or a blend, by the weights. `wind` is
/// relative to the foot; a null state means procedural.
std::vector<JointAngles> modalAngles(const Tree& tree, const wind::Instant& wind,
                                     const Weights& weights, const ModalTreeState* modal_state,
                                     Nanoseconds stamp);

/// Returns the bends of one joint for modal amplitudes, within the limits of joints.
JointAngles bendOf(const ModalTree& modes, const std::vector<double>& amplitude, int branch);
/// Returns the linear interpolation with the given weight of `to`.
JointAngles interpolate(const JointAngles& from, const JointAngles& to, double weight);

}  // namespace vegetation_sim::forest
