// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/model/beam_shape.h"

#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scan {

void describe(FieldVisitor& v, BeamShape& b) {
  v.number("divergence", b.divergence, "rad", {0.0, 0.1});
  v.integer("samples", b.samples, "", {1, 37});
  v.number("return_separation", b.separation, "m", {0.0, 10.0});
}

void check(const BeamShape& b, const std::string& context, Faults& faults) {
  if (b.samples != 1 && b.samples != 7 && b.samples != 19 && b.samples != 37)
    faults.add(context + "samples = " + std::to_string(b.samples) + " is none of 1, 7, 19, 37");
}

// A disc of n rays of equal area has the radius sqrt(n) in units of one ray's, whatever the rest.
BeamPattern::BeamPattern(const BeamShape& shape) : across_{{0.0, 0.0}} {
  const SinCos half = sinCos(0.5 * shape.divergence);
  const double edge = half.sin / half.cos;
  for (int ring = 1, inner = 1; inner < shape.samples; ++ring) {
    const double radius = edge * std::sqrt((inner + 3.0 * ring) / shape.samples);
    for (int i = 0; i < 6 * ring; ++i) {
      const SinCos turn = sinCosTurns((i + 0.5 * (ring % 2)) / (6.0 * ring));
      across_.push_back({radius * turn.cos, radius * turn.sin});
    }
    inner += 6 * ring;
  }
}

Vec3 BeamPattern::direction(const Vec3& axis, int ray) const {
  if (ray == 0) return axis;
  const Offset& offset = across_[static_cast<std::size_t>(ray)];
  const Vec3 other = std::fabs(axis.z()) < 0.9 ? Vec3(Vec3::UnitZ()) : Vec3(Vec3::UnitX());
  const Vec3 side = cross(other, axis), u = side / length(side), v = cross(axis, u);
  const Vec3 out = axis + offset.u * u + offset.v * v;
  return out / length(out);
}

}  // namespace vegetation_sim::scan
