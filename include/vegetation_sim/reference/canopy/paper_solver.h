// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/canopy/plane/plane_field.h"

namespace vegetation_sim::canopy {

/// The solver of Stam 1999 as paper 3 uses it (S3-11): bilinear advection, then viscosity and
/// pressure each by a fixed number of Gauss-Seidel sweeps. It is less accurate than the others:
/// twenty sweeps leave most of the divergence of large eddies (docs/performance.md).
class PaperSolver {
 public:
  /// @param warm starts the pressure from the last step's instead of zero.
  PaperSolver(int size, int sweeps, bool warm);

  /// One step without sources: advection, viscosity, projection.
  /// @param decay viscosity * dt / width^2 [-]. @param cells dt / dx: cells passed at 1 m/s.
  void step(PlaneField& flow, double decay, double cells);
  /// Subtracts the gradient of the pressure that the sweeps find.
  void project(PlaneField& flow);
  /// Resets the stored pressure.
  void reset();

 private:
  void relax(std::vector<double>& x, const std::vector<double>& right, double weight) const;

  int size_, sweeps_;
  bool warm_;
  std::vector<double> pressure_, divergence_;
  PlaneField scratch_;
};

}  // namespace vegetation_sim::canopy
