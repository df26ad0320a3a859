// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/waiting_areas.h"

namespace vegetation_sim {
namespace {

std::size_t pointsOf(const GrassCut& cut) {
  return cut.outline.size() + cut.swath.size();
}

}  // namespace

void checkRoomToWait(const EventQueue<GrassEvent>& inputs, const GrassCut& cut, double work) {
  inputs.checkShare("points of cuts that wait", pointsOf(cut), MOST_WAITING_POINTS,
                    [](const GrassEvent& event) { return pointsOf(event.cut); });
  checkWorkToWait(inputs, work);
}

void checkDiscsToWait(const EventQueue<GrassEvent>& inputs, std::size_t discs) {
  inputs.checkShare("discs of colour that wait", discs, MOST_WAITING_DISCS,
                    [](const GrassEvent& event) { return event.colours.size(); });
}

void checkWorkToWait(const EventQueue<GrassEvent>& inputs, double work) {
  inputs.checkCost("nodes of treads and cuts that wait", static_cast<std::size_t>(work),
                   MOST_WAITING_WORK);
}

}  // namespace vegetation_sim
