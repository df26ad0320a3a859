// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/grass_events.h"

#include "vegetation_sim/ros/conversions/grass_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {

std::string applyToGrass(const GrassEvent& event, const GrassTuning& tuning,
                         grass::TreadSimulation& simulation) {
  switch (event.kind) {
    case GrassEvent::TREAD:
      return simulation.apply(fromMsg(event.tread, tuning.tread, tuning.height_gate),
                              fromMsg(event.header.stamp));
    case GrassEvent::CLEAR:
      if (event.all)
        simulation.raiseAll();
      else
        simulation.raise({event.centre.x, event.centre.y}, event.radius);
      return "";
    case GrassEvent::CUT:
      simulation.cut(fromMsg(event.cut, "cut: "));
      return "";
    default:
      throw InvalidInput("kind = " + std::to_string(event.kind) + " is outside 0 to 6");
  }
}

}  // namespace vegetation_sim
