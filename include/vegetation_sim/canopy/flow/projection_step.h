// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/canopy/plane/fourier_plane.h"

namespace vegetation_sim::canopy {

/// Removes the divergence of a flow exactly, mode by mode, and applies viscosity exactly in the
/// same pass. The mean flow stays. Modes at the highest wave number have no direction and are
/// dropped. docs/canopy.md derives the formula.
class ProjectionStep {
 public:
  explicit ProjectionStep(int size);

  /// @param decay viscosity * dt / width^2, from 0 [-].
  void project(PlaneField& flow, double decay);

 private:
  void setDecay(double decay);

  FourierPlane fourier_;
  std::vector<double> turn_re_, turn_im_;  // K^2 / |K|^2 with K = kx + i ky
  std::vector<double> half_damping_;       // exp(-decay (2 pi k)^2) / 2
  double decay_{-1.0};
};

}  // namespace vegetation_sim::canopy
