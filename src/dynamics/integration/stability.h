// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "reference/dynamics/paper_dynamics.h"

namespace vegetation_sim::physics {

/// How a chain steps in time, from the most trusted to the one that only shows how it breaks.
enum class Integrator : int {
  MIDPOINT = 0,             ///< linearly implicit midpoint with a guard: second order (default)
  IMPLICIT_EULER = 1,       ///< linearly implicit: first order, over-damped
  SEMI_IMPLICIT_EULER = 2,  ///< stable for h^2 w^2 + 2 h c < 4 per joint (E12)
  EXPLICIT_EULER = 3,       ///< as paper 1 prints it (S1-33)
  RUNGE_KUTTA_4 = 4         ///< the reference: fourth order, explicit
};

/// At which rates the midpoint feels velocity products (centrifugal, gyroscopic).
enum class Products : int {
  MEAN = 0,  ///< the mean of what they are before and after the step: second order (default)
  START = 1  ///< before: first order in them, and faster
};

/// What moves a chain.
enum class Dynamics : int {
  ARTICULATED = 0,   ///< the full chain
  PAPER = 1,         ///< paper 1's, put right (E2, E11, E13)
  PAPER_PRINTED = 2  ///< paper 1's, as printed
};

inline bool isImplicit(Integrator integrator) {
  return integrator == Integrator::MIDPOINT || integrator == Integrator::IMPLICIT_EULER;
}

/// Theory of one joint q'' = -w^2 q - c q' (E12): the step at which `integrator` ceases to be
/// stable [s]; infinite for implicit ones. `w2` in rad^2/s^2, `c` in 1/s.
double jointLimit(Integrator integrator, double w2, double c);

/// Bounds of a whole chain at a pose: no motion's Rayleigh quotients exceed them.
struct ChainRates {
  double spring{0.0};  ///< largest w^2 [1/s^2]
  double damper{0.0};  ///< largest c [1/s]
  double beta{0.0};    ///< smallest damping per stiffness of any joint or anchor [s]
};

/// Gershgorin's bounds in the links' own turns (E12, docs/physics.md): only the energy of turning
/// about centres of mass is counted, so lever arms cannot spoil them.
ChainRates guardRates(Dynamics dynamics, const std::vector<Link>& links,
                      const Kinematics& kinematics, const std::vector<Anchor>& anchors = {});

/// The same by power iteration on the full chain, padded; no proof, but as tight as the chain
/// allows, where the guard does not see that a link's whole sub-tree moves with it. O(N).
ChainRates estimatedRates(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                          const ChainState& state, const std::vector<Anchor>& anchors);

/// A step that is stable for sure while motion is small [s]; infinite for implicit methods.
double guardLimit(Integrator integrator, const ChainRates& rates);

/// The smaller of both, bound for bound.
ChainRates tighter(const ChainRates& guard, const ChainRates& estimate);

constexpr double GUARD_MARGIN = 0.9;  ///< of the guard's limit, for motion that is not small
constexpr int MOST_SUB_STEPS = 64;    ///< beyond, an explicit method is refused

/// Equal parts that a step of `h` must be run in to keep below `limit`; 0: refused.
int subSteps(double limit, double h);

}  // namespace vegetation_sim::physics
