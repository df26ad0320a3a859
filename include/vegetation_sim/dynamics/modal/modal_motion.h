// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/dynamics/modal/modes.h"

namespace vegetation_sim::physics {

/// All that a tree in modes remembers: of each oscillator the amplitude and its rate.
struct ModalState {
  std::vector<double> amplitude, rate;  ///< [modes]
};

/// Modes are small motion: where turns that gather along a way from the ground exceed this, tips
/// are 10 % off and it grows fast (docs/modal.md) [rad].
constexpr double MODAL_LIMIT = 1.0;

/// Turns of the links where each mode turns most, from which the rotation that has gathered along
/// any way from the ground is told without visiting every link.
struct RotationProbe {
  std::vector<int> links;  ///< where it looks
  std::vector<Vec3> turn;  ///< [links][modes] world turn per amplitude [rad]

  RotationProbe() = default;
  RotationProbe(const LinearChain& chain, const Modes& modes);
  /// Largest turn of any of them from rest [rad]. @param[in] amplitude [modes].
  double largestTurn(const std::vector<double>& amplitude) const;
  /// False: the tree should be physical.
  bool holds(const ModalState& state) const { return largestTurn(state.amplitude) <= MODAL_LIMIT; }
};

/// Steps oscillators exactly, whatever the step, for loads that change linearly during it.
class ModalStepper {
 public:
  explicit ModalStepper(const Modes& modes);

  std::size_t size() const { return square_.size(); }
  ModalState atRest() const;
  /// @param[in] before, after modal loads [modes] at the start and the end of the step.
  void step(const std::vector<double>& before, const std::vector<double>& after, double h,
            ModalState& state);
  /// Accelerations under a modal load [modes].
  void accelerations(const ModalState& state, const std::vector<double>& load,
                     std::vector<double>& out) const;

 private:
  struct Propagator {
    double aa, ab, ba, bb;  // amplitude and rate after h, of what they are
  };
  void prepare(double h);

  std::vector<double> square_, damping_;  // w^2, rate
  std::vector<Propagator> propagators_;   // for steps of step_
  double step_{-1.0};
};

}  // namespace vegetation_sim::physics
