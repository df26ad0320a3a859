// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/canopy/plane/plane_field.h"

namespace vegetation_sim::canopy {

/// Equation of motion of the leaves, a'' + 2 damping omega a' + omega^2 a - speed^2 laplace a =
/// omega^2 g on a periodic square. Under a steady even force its equilibrium is a = g (S3-12).
struct WaveLaw {
  double omega{6.283};   ///< angular frequency without neighbours [rad/s]
  double damping{0.15};  ///< share of the critical damping
  double speed{0.5};     ///< speed of waves through the leaves [m/s]
  double width{4.0};     ///< side of the square [m]
};

/// Transition of (a - equilibrium, a') of one mode over a step under a constant force.
struct ModeStep {
  double keep, from_rate, to_rate, keep_rate;
};
/// Returns the exact step of a mode of `stiffness` omega^2 + speed^2 k^2: under-, over- and
/// critically damped, for any dt from 0.
ModeStep modeStep(double alpha, double stiffness, double dt);

/// The exact step of every mode, on spectra in the order of FourierPlane.
class ModalStep {
 public:
  ModalStep(const WaveLaw& law, int size);
  void step(double dt, const PlaneField& force, PlaneField& amplitude, PlaneField& rate);

 private:
  void setStep(double dt);

  WaveLaw law_;
  int size_;
  double dt_{-1.0};
  std::vector<ModeStep> steps_;
  std::vector<double> compliance_;  // equilibrium / force
};

/// Verlet's step with damping at the middle of the step (paper 3), on cells. `rate` belongs to half
/// a step before. It is unstable from longestStep() on and does not check that.
class VerletStep {
 public:
  VerletStep(const WaveLaw& law, int size);
  /// Returns the stability limit dt^2 (8 speed^2 / dx^2 + omega^2) < 4, which is Courant's 1 /
  /// sqrt(2) if omega is 0 [s].
  double longestStep() const { return longest_; }
  void step(double dt, const PlaneField& force, PlaneField& amplitude, PlaneField& rate);

 private:
  WaveLaw law_;
  double longest_;
  PlaneField pull_;
};

}  // namespace vegetation_sim::canopy
