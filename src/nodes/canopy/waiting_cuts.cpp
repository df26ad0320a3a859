// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/canopy/waiting_cuts.h"

#include "nodes/cutters/cut_request.h"

namespace vegetation_sim {

void checkRoomToWait(const EventQueue<CanopyEvent>& inputs, std::size_t plants) {
  std::size_t waiting = 0;
  inputs.each([&](const CanopyEvent& event) { waiting += event.cut_plants.size(); });
  checkRoomToWait("plants of cuts that wait", waiting, plants, MOST_WAITING_PLANTS);
}

}  // namespace vegetation_sim
