// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Work of inputs, counted in nodes, so that it is the same on every machine.
#include <algorithm>
#include <cmath>

#include "grass/tread_simulation.h"

namespace vegetation_sim::grass {
namespace {

std::string wholeNumber(double value) {
  return std::to_string(static_cast<std::int64_t>(value));
}

}  // namespace

TreadSimulation::StrokeSteps TreadSimulation::stepsOf(const TreadInput& stroke) const {
  const MapLaw& law = layout_.map->law();
  const Vec3 way = stroke.position - stroke.start;
  const double longest = 0.5 * treading_.longest_stroke, margin = stroke.law.reach + longest;
  StrokeSteps out;
  out.count = 1.0 + std::floor(length(way) / longest);
  const Vec3 low(law.origin_x, law.origin_y, 0.0);
  const Vec3 size(law.resolution * (law.columns - 1), law.resolution * (law.rows - 1), 0.0);
  double begin = 0.0, end = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double below = low[axis] - margin - stroke.start[axis];
    const double above = below + size[axis] + 2.0 * margin;
    if (way[axis] == 0.0) {
      if (below > 0.0 || above < 0.0) return out;
      continue;
    }
    const auto [enters, leaves] = std::minmax({below / way[axis], above / way[axis]});
    begin = std::max(begin, enters), end = std::min(end, leaves);
  }
  if (begin > end) return out;
  out.first = std::floor(begin * out.count);
  out.last = std::min(out.count, std::ceil(end * out.count));
  return out;
}

// A press acts on all nodes within reach of its step.
double TreadSimulation::nodesOf(double presses, double reach, double step) const {
  const double spacing = tread_.spacing(), side = 2.0 * reach / spacing + 3.0;
  return std::floor(presses * side * (side + step / spacing));
}

double TreadSimulation::workOf(const TreadInput& input) const {
  const double reach = input.law.reach;
  switch (input.action) {
    case TreadAction::LIFT:
      return 0.0;
    case TreadAction::PLACE:
      return nodesOf(1.0, reach, 0.0);
    case TreadAction::STROKE: {
      const StrokeSteps steps = stepsOf(input);
      return nodesOf(steps.last - steps.first + 1.0, reach,
                     length(input.position - input.start) / steps.count);
    }
    default:  // a longer step is a jump, which presses around its end only
      return nodesOf(1.0, reach, treading_.longest_stroke);
  }
}

void TreadSimulation::checkStroke(const TreadInput& stroke) const {
  const double nodes = workOf(stroke);
  if (nodes > MOST_STROKE_NODES)
    throw InvalidInput("stroke of source " + inQuotes(stroke.source) + ": " + wholeNumber(nodes) +
                       " nodes to press, more than the " + wholeNumber(MOST_STROKE_NODES) +
                       " allowed");
}

}  // namespace vegetation_sim::grass
