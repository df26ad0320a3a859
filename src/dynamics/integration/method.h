// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vegetation_sim::physics {

/// Time integration of a chain, ordered from the most robust method to the reference.
enum class Integrator : int {
  MIDPOINT = 0,             ///< linearly implicit midpoint with a guard: second order (default)
  IMPLICIT_EULER = 1,       ///< linearly implicit: first order, over-damped
  SEMI_IMPLICIT_EULER = 2,  ///< stable for h^2 w^2 + 2 h c < 4 per joint (E12)
  EXPLICIT_EULER = 3,       ///< as paper 1 prints it (S1-33)
  RUNGE_KUTTA_4 = 4         ///< the reference: fourth order, explicit
};

/// Equations of motion of a chain.
enum class Dynamics : int {
  ARTICULATED = 0,   ///< the full chain
  PAPER = 1,         ///< those of paper 1, corrected (E2, E11, E13)
  PAPER_PRINTED = 2  ///< those of paper 1, as printed
};

inline bool isImplicit(Integrator integrator) {
  return integrator == Integrator::MIDPOINT || integrator == Integrator::IMPLICIT_EULER;
}

}  // namespace vegetation_sim::physics
