// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wind/field_archive.h"

#include "core/archive/archive.h"
#include "wind/limits.h"

namespace vegetation_sim::wind {

void archive(Archive& a, Primitive& p) {
  a.integer("primitive id", p.id);
  a.text("primitive name", p.name, MAX_NAME);
  a.stamp("epoch", p.epoch);
  a.stamp("t_on", p.t_on);
  a.stamp("t_off", p.t_off);
  Archive::Fields fields(a, "primitive", false);
  describeAll(fields, p);
  a.list("trajectory", p.trajectory, MAX_WAYPOINTS, 4 * sizeof(double), [&a](Waypoint& point) {
    a.stamp("way point stamp", point.stamp);
    a.vector("way point", point.position);
  });
}

void archive(Archive& a, Field& field) {
  std::uint64_t seed = field.seed();
  std::vector<Primitive> primitives = field.primitives();
  a.key(seed);
  a.list("primitives", primitives, MAX_PRIMITIVES, 100, [&a](Primitive& p) { archive(a, p); });
  if (a.reads()) field = Field(std::move(primitives), seed);
}

}  // namespace vegetation_sim::wind
