// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/waiting_areas.h"

namespace vegetation_sim {
namespace {

std::size_t pointsOf(const GrassCut& cut) {
  return cut.outline.size() + cut.swath.size();
}

}  // namespace

void checkRoomToWait(const EventQueue<GrassEvent>& inputs, const GrassCut& cut) {
  inputs.checkShare("points of cuts that wait", pointsOf(cut), MOST_WAITING_POINTS,
                    [](const GrassEvent& event) { return pointsOf(event.cut); });
}

}  // namespace vegetation_sim
