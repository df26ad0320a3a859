// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/growth/limb_rule.h"

namespace vegetation_sim::forest {

void describe(FieldVisitor& v, LimbRule& r) {
  v.number("children", r.children, "", {0.0, 200.0});
  v.integer("whorl", r.whorl, "", {1, 12});
  v.number("start", r.start, "", {0.0, 1.0});
  v.number("end", r.end, "", {0.0, 1.0});
  v.number("length", r.length, "", {0.01, 3.0});
  v.number("length_variation", r.length_variation, "", {0.0, 0.9});
  v.choice("crown", r.crown, {"even", "conical", "round", "flame"});
  v.number("radius", r.radius, "", {0.01, 1.0});
  v.number("taper", r.taper, "", {0.05, 1.0});
  v.number("angle_low", r.angle_low, "rad", {0.0, 2.8});
  v.number("angle_high", r.angle_high, "rad", {0.0, 2.8});
  v.number("angle_variation", r.angle_variation, "rad", {0.0, 1.5});
  v.number("rise", r.rise, "rad", {-3.1, 3.1});
  v.number("wander", r.wander, "rad", {0.0, 3.0});
  v.integer("segments", r.segments, "", {1, 16});
  v.number("leaves", r.leaves, "", {0.0, 100.0});
}

}  // namespace vegetation_sim::forest
