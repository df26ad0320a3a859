// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/integration/method.h"
#include "reference/dynamics/paper_dynamics.h"

namespace vegetation_sim::physics {

/// The rates at which the midpoint evaluates velocity products (centrifugal, gyroscopic).
enum class Products : int {
  MEAN = 0,  ///< mean of the products before and after the step: second order (default)
  START = 1  ///< products before the step: first order in them, and faster
};

/// Returns, by the theory of one joint q'' = -w^2 q - c q' (E12), the step at which `integrator`
/// becomes unstable [s]; infinite for implicit ones. `w2` in rad^2/s^2, `c` in 1/s.
double jointLimit(Integrator integrator, double w2, double c);

/// Bounds of a whole chain at a pose: the Rayleigh quotients of any motion stay below them.
struct ChainRates {
  double spring{0.0};  ///< largest w^2 [1/s^2]
  double damper{0.0};  ///< largest c [1/s]
  double beta{0.0};    ///< smallest damping per stiffness of any joint or anchor [s]
};

/// Returns Gershgorin's bounds in the turns of the links (E12, docs/physics.md). Only the energy of
/// turning about centres of mass is counted, so lever arms cannot weaken them.
ChainRates guardRates(Dynamics dynamics, const std::vector<Link>& links,
                      const Kinematics& kinematics, const std::vector<Anchor>& anchors = {});

/// Estimates the same by power iteration on the full chain, plus a margin. This is no proof, but
/// tight where the guard ignores that a link's whole sub-tree moves with it. O(N).
ChainRates estimatedRates(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                          const ChainState& state, const std::vector<Anchor>& anchors);

/// Returns a step that is stable for certain while motion is small [s]; infinite for implicit
/// methods.
double guardLimit(Integrator integrator, const ChainRates& rates);

/// Returns the smaller of both, bound by bound.
ChainRates tighter(const ChainRates& guard, const ChainRates& estimate);

constexpr double GUARD_MARGIN = 0.9;  ///< share of the guard's limit, for motion that is not small
constexpr int MOST_SUB_STEPS = 64;    ///< an explicit method that needs more is rejected

/// Returns the number of equal parts that a step of `h` must be run in to keep below `limit`, or 0
/// if there are too many.
int subSteps(double limit, double h);

}  // namespace vegetation_sim::physics
