// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/lod/colour_mask.h"

#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::grass {

void describe(FieldVisitor& v, ColourMask& m) {
  v.number("x", m.centre.x, "m", {-1e7, 1e7});
  v.number("y", m.centre.y, "m", {-1e7, 1e7});
  v.number("radius", m.radius, "m", {0.1, 1e4});
  v.number("colour", m.colour, "", {0.0, 1.0});
  v.number("weight", m.weight, "", {0.0, 100.0});
  v.number("velocity_x", m.velocity.x, "m/s", {-50.0, 50.0});
  v.number("velocity_y", m.velocity.y, "m/s", {-50.0, 50.0});
}

double weightAt(const ColourMask& mask, double x, double y) {
  const double dx = x - mask.centre.x, dy = y - mask.centre.y;
  return mask.weight * smootherStep(1.0 - std::sqrt(dx * dx + dy * dy) / mask.radius);
}

double averageColour(double colour, const std::vector<ColourMask>& masks, double x, double y) {
  double weight = 0.0, sum = 0.0;
  for (const ColourMask& mask : masks) {
    const double own = weightAt(mask, x, y);
    weight += own;
    sum += own * mask.colour;
  }
  return (colour + sum) / (1.0 + weight);
}

std::vector<ColourMask> ColourMasks::at(Nanoseconds when) const {
  std::vector<ColourMask> out = list;
  const double since = secondsBetween(stamp, when);
  for (ColourMask& mask : out) {
    mask.centre.x += since * mask.velocity.x;
    mask.centre.y += since * mask.velocity.y;
  }
  return out;
}

void check(const ColourMasks& masks, Faults& faults) {
  if (masks.list.size() > ColourMasks::MOST)
    faults.add("colours has " + std::to_string(masks.list.size()) + " discs, allowed are " +
               std::to_string(ColourMasks::MOST));
  for (std::size_t i = 0; i < masks.list.size(); ++i) {
    FieldChecker checker("colours[" + std::to_string(i) + "].", faults);
    ColourMask mask = masks.list[i];
    describe(checker, mask);
  }
}

std::vector<ColourMask> readColourMasks(YamlSection& section) {
  ColourMasks out;
  for (YamlSection& entry : section.sections("colours")) {
    ColourMask mask;
    describe(entry, mask);
    entry.finish();
    out.list.push_back(mask);
  }
  if (out.list.size() > ColourMasks::MOST)
    section.fault("colours", "has " + std::to_string(out.list.size()) + " discs, allowed are " +
                                 std::to_string(ColourMasks::MOST));
  return out.list;
}

}  // namespace vegetation_sim::grass
