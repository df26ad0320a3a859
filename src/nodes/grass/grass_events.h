// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/GrassEvent.h>

#include "grass/tread_simulation.h"
#include "nodes/grass/grass_options.h"

namespace vegetation_sim {

/// Treads, cuts or raises grass. @return what TreadSimulation::apply() returns for a tread, else an
/// empty text. @throws InvalidInput, and then nothing has changed, also for another kind.
std::string applyToGrass(const GrassEvent& event, const GrassTuning& tuning,
                         grass::TreadSimulation& simulation);

/// Returns at most how many nodes the tread or cut of an event presses, in the time of which it is
/// applied. An event that is no valid one has no work: it is refused.
double workOf(const GrassEvent& event, const grass::TreadSimulation& simulation);

}  // namespace vegetation_sim
