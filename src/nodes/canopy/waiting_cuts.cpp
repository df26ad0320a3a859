// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/canopy/waiting_cuts.h"

namespace vegetation_sim {

void checkRoomToWait(const EventQueue<CanopyEvent>& inputs, std::size_t plants) {
  inputs.checkShare("plants of cuts that wait", plants, MOST_WAITING_PLANTS,
                    [](const CanopyEvent& event) { return event.cut_plants.size(); });
}

}  // namespace vegetation_sim
