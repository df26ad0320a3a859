// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/GrassEvent.h>

#include <cstddef>

#include "nodes/base/event_queue.h"

namespace vegetation_sim {

/// Largest number of points in the outlines of all areas to cut that wait for their tick together,
/// those of swaths included: 48 MB. A client may have half of what others leave.
constexpr std::size_t MOST_WAITING_POINTS = 2'000'000;

/// Checks that a cut of this area may wait. @throws InvalidInput
void checkRoomToWait(const EventQueue<GrassEvent>& inputs, const GrassCut& cut);

}  // namespace vegetation_sim
