// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/waiting_areas.h"

#include "nodes/cutters/cut_request.h"

namespace vegetation_sim {
namespace {

std::size_t pointsOf(const GrassCut& cut) {
  return cut.outline.size() + cut.swath.size();
}

}  // namespace

void checkRoomToWait(const EventQueue<GrassEvent>& inputs, const GrassCut& cut, double work) {
  std::size_t waiting = 0;
  inputs.each([&](const GrassEvent& event) { waiting += pointsOf(event.cut); });
  checkRoomToWait("points of cuts that wait", waiting, pointsOf(cut), MOST_WAITING_POINTS);
  checkWorkToWait(inputs, work);
}

void checkWorkToWait(const EventQueue<GrassEvent>& inputs, double work) {
  checkRoomToWait("nodes of treads and cuts that wait", static_cast<std::size_t>(inputs.cost()),
                  static_cast<std::size_t>(work), static_cast<std::size_t>(MOST_WAITING_WORK));
}

}  // namespace vegetation_sim
