// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/canopy/plane/plane_field.h"

namespace vegetation_sim::canopy {

/// a'' + 2 damping omega a' + omega^2 a - speed^2 laplace a = omega^2 g on a periodic square: what
/// moves in the plane, with an equilibrium a = g under a steady even force (S3-12).
struct WaveLaw {
  double omega{6.283};   ///< of a part without neighbours [rad/s]
  double damping{0.15};  ///< share of the critical one
  double speed{0.5};     ///< of waves through the leaves [m/s]
  double width{4.0};     ///< of the square [m]
};

/// How one mode goes on in a step under a constant force: of (a - equilibrium, a').
struct ModeStep {
  double keep, from_rate, to_rate, keep_rate;
};
/// The exact step of a mode of `stiffness` omega^2 + speed^2 k^2, in all regimes: under-, over- and
/// critically damped, any dt from 0.
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
/// a step before. Unstable from longestStep() on, which it leaves to the caller.
class VerletStep {
 public:
  VerletStep(const WaveLaw& law, int size);
  /// dt^2 (8 speed^2 / dx^2 + omega^2) < 4: Courant's 1 / sqrt(2) if omega is 0 [s].
  double longestStep() const { return longest_; }
  void step(double dt, const PlaneField& force, PlaneField& amplitude, PlaneField& rate);

 private:
  WaveLaw law_;
  double longest_;
  PlaneField pull_;
};

}  // namespace vegetation_sim::canopy
