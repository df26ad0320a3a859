// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/growth/physics_settings.h"

namespace vegetation_sim::forest {

void describe(FieldVisitor& v, PhysicsSettings& s) {
  v.choice("dynamics", s.dynamics, {"articulated", "paper", "paper_printed"});
  v.choice(
      "integrator", s.integrator,
      {"midpoint", "implicit_euler", "semi_implicit_euler", "explicit_euler", "runge_kutta_4"});
  v.choice("precision", s.precision, {"single", "double"});
  v.choice("material", s.material, {"beam", "paper"});
  v.choice("wind_forcing", s.wind_forcing, {"compensated", "paper"});
  v.choice("promotion", s.promotion, {"influence", "depth"});
  v.number("influence_tolerance", s.influence_tolerance, "m", {1e-6, 10.0});
  v.integer("most_branches", s.most_branches, "", {1, 1000000});
  v.number("fade", s.fade, "s", {0.0, 3600.0});
  v.number("linger", s.linger, "s", {0.0, 3600.0});
  v.number("blend", s.blend, "s", {0.01, 60.0});
  describe(v, s.contact);
}

}  // namespace vegetation_sim::forest
