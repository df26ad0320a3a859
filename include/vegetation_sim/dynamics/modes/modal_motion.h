// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/dynamics/modes/modes.h"

namespace vegetation_sim::physics {

/// The whole state of a tree in modes: the amplitude of each oscillator and its rate.
struct ModalState {
  std::vector<double> amplitude, rate;  ///< [modes]
};

/// Largest turn for which modes hold [rad]. Modes are small motion: where turns along a path from
/// the ground add up to more, tips are 10 % off, and the error grows fast (docs/modal.md).
constexpr double MODAL_LIMIT = 1.0;

/// Turns of the links where each mode turns most. They give the largest turn along any path from
/// the ground without visiting every link.
struct RotationProbe {
  std::vector<int> links;  ///< the links that are probed
  std::vector<Vec3> turn;  ///< [links][modes] world turn per amplitude [rad]

  RotationProbe() = default;
  RotationProbe(const LinearChain& chain, const Modes& modes);
  /// Returns the largest turn of a probed link from rest [rad]. @param[in] amplitude [modes].
  double largestTurn(const std::vector<double>& amplitude) const;
  /// Returns whether the modes hold; if not, the tree should be physical.
  bool holds(const ModalState& state) const { return largestTurn(state.amplitude) <= MODAL_LIMIT; }
};

/// Steps oscillators exactly, for any length of step, under loads that change linearly during it.
class ModalStepper {
 public:
  explicit ModalStepper(const Modes& modes);

  std::size_t size() const { return square_.size(); }
  const std::vector<double>& squares() const { return square_; }  ///< w^2 [modes] [1/s^2]
  ModalState atRest() const;
  /// @param[in] before, after are the modal loads [modes] at the start and the end of the step.
  void step(const std::vector<double>& before, const std::vector<double>& after, double h,
            ModalState& state);
  /// Returns the accelerations under a modal load [modes].
  void accelerations(const ModalState& state, const std::vector<double>& load,
                     std::vector<double>& out) const;

 private:
  struct Propagator {
    double aa, ab, ba, bb;  // amplitude and rate after h as functions of amplitude and rate before
  };
  void prepare(double h);

  std::vector<double> square_, damping_;  // w^2, rate
  std::vector<Propagator> propagators_;   // for steps of step_
  double step_{-1.0};
};

}  // namespace vegetation_sim::physics
