// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/grass_events.h"

#include <algorithm>

#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr double CUT_WORK = 25.0;  // nodes that are pressed in the time of one that is cut
constexpr double MOST_WORK = 1e10;

double cutWorkOf(const GrassCut& cut, const grass::TreadSimulation& simulation) {
  try {
    return CUT_WORK * simulation.workOf(fromMsg(cut, "cut: "));
  } catch (const InvalidInput&) {
    return 0.0;
  }
}

}  // namespace

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

// Reads only what the work of a tread depends on, since each tread is counted. One of a damaged
// snapshot may have any numbers.
double workOf(const GrassEvent& event, const grass::TreadSimulation& simulation) {
  if (event.kind == GrassEvent::CUT) return cutWorkOf(event.cut, simulation);
  if (event.kind != GrassEvent::TREAD) return 0.0;
  grass::TreadInput input;
  input.action = static_cast<grass::TreadAction>(event.tread.action);
  input.start = fromMsg(event.tread.start);
  input.position = fromMsg(event.tread.position);
  input.law.reach = event.tread.law.reach;
  const double work = simulation.workOf(input);
  return work > 0.0 ? std::min(work, MOST_WORK) : 0.0;
}

}  // namespace vegetation_sim
