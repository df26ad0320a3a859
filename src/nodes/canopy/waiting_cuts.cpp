// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/canopy/waiting_cuts.h"

#include <string>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {

void checkRoomToWait(const EventQueue<CanopyEvent>& inputs, std::size_t plants) {
  std::size_t waiting = 0;
  inputs.each([&](const CanopyEvent& event) { waiting += event.cut_plants.size(); });
  if (waiting + plants > MOST_WAITING_PLANTS)
    throw InvalidInput("plants of cuts that wait = " + std::to_string(waiting + plants) +
                           " with the " + std::to_string(plants) +
                           " of this request, allowed are 0 to " +
                           std::to_string(MOST_WAITING_PLANTS),
                       FaultCode::NO_ROOM);
}

}  // namespace vegetation_sim
