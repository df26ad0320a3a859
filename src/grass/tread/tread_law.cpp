// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/tread/tread_law.h"

#include <cmath>

namespace vegetation_sim::grass {

void describe(FieldVisitor& v, TreadLaw& law) {
  v.number("radius", law.radius, "m", TREAD_RADIUS);
  v.number("reach", law.reach, "m", {0.01, 10.0});
  v.number("softness", law.softness, "m", {0.001, 5.0});
  v.number("load", law.load, "", {0.0, 10.0});
  v.number("recovery", law.recovery, "s", {0.0, PERMANENT_RECOVERY});
}

void check(TreadLaw law, const std::string& context, Faults& faults) {
  FieldChecker checker(context, faults);
  describe(checker, law);
  if (TREAD_RADIUS.contains(law.radius) && law.reach < 1.5 * law.radius)
    faults.add(context + "reach = " + std::to_string(law.reach) +
               " m is below 1.5 times radius = " + std::to_string(law.radius) + " m");
}

CompactField::CompactField(const Point& p0, const Point& p1, double reach, double softness) {
  parts_.p0 = p0;
  parts_.square_reach = reach * reach;
  parts_.square_softness = softness * softness;
  const double length = distanceBetween(p0, p1);
  if (length > SHORTEST_STROKE) {
    parts_.length = length;
    parts_.along = {(p1.x - p0.x) / length, (p1.y - p0.y) / length};
  }
  const double square_end = parts_.square_reach + parts_.square_softness;
  parts_.end = std::sqrt(square_end);
  parts_.edge = 1.0 / (square_end * parts_.end);
}

double CompactField::ofEndlessTrack(double distance, double reach, double softness) {
  return CompactField({-2.0 * reach, 0.0}, {2.0 * reach, 0.0}, reach, softness)
      .fieldAt(Point{0.0, distance});
}

}  // namespace vegetation_sim::grass
