// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/dynamics/modes/modal_motion.h"

namespace vegetation_sim::physics {

/// Steps oscillators whose damping couples them, a'' + D a' + w^2 a = f, by the implicit midpoint
/// rule, which is stable for steps of any length. @param[in] square w^2 [modes] [1/s^2],
/// damping D [modes][modes], symmetric and positive semi-definite [1/s], before, after the modal
/// loads [modes] at the start and the end of the step, h [s].
void stepCoupled(const std::vector<double>& square, const std::vector<double>& damping,
                 const std::vector<double>& before, const std::vector<double>& after, double h,
                 ModalState& state);
/// Computes their accelerations [modes] under a modal load.
void coupledAccelerations(const std::vector<double>& square, const std::vector<double>& damping,
                          const ModalState& state, const std::vector<double>& load,
                          std::vector<double>& out);

}  // namespace vegetation_sim::physics
