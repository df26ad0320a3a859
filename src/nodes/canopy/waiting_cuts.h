// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/CanopyEvent.h>

#include <cstddef>

#include "nodes/base/event_queue.h"

namespace vegetation_sim {

/// Largest number of plants in all cuts that wait for their tick together: 8 MB. A client may have
/// half of what others leave.
constexpr std::size_t MOST_WAITING_PLANTS = 2'000'000;

/// Checks that a cut of so many plants may wait. @throws InvalidInput
void checkRoomToWait(const EventQueue<CanopyEvent>& inputs, std::size_t plants);

}  // namespace vegetation_sim
