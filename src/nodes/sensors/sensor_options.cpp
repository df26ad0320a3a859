// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/sensors/sensor_options.h"

namespace vegetation_sim {

void describe(FieldVisitor& v, SensorOptions& o) {
  v.number("delay", o.delay, "s", {0.0, 5.0});
  v.number("tolerance", o.tolerance, "m", {1e-4, 10.0});
  v.integer("branch_budget", o.branch_budget, "", {1000, 20000000});
  v.integer("leaf_budget", o.leaf_budget, "", {1000, 3000000});
  v.integer("threads", o.threads, "", {1, 64});
}

void readNames(Parameters& parameters, SensorOptions& options) {
  parameters.frame("frame_id", options.frame_id);
  parameters.seed("seed", options.seed);
}

scan::Scene makeScene(const SensorOptions& options) {
  scan::Scene out;
  out.trees = scan::Trees(static_cast<std::size_t>(options.branch_budget));
  out.plants = scan::Plants(static_cast<std::size_t>(options.leaf_budget));
  out.crowns = scan::Crowns(static_cast<std::size_t>(options.leaf_budget));
  return out;
}

}  // namespace vegetation_sim
