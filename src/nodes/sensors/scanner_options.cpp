// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/sensors/scanner_options.h"

#include "ros/params/parameters.h"

namespace vegetation_sim {

void describe(FieldVisitor& v, ScanOptions& o) {
  v.integer("rate", o.rate, "Hz", {1, 100});
  v.number("delay", o.delay, "s", {0.0, 5.0});
  v.number("tolerance", o.tolerance, "m", {1e-4, 10.0});
  v.integer("branch_budget", o.branch_budget, "", {1000, 20000000});
  v.integer("threads", o.threads, "", {1, 64});
  describe(v, o.beams);
}

ScanOptions loadScanOptions(const ros::NodeHandle& private_handle) {
  ScanOptions out;
  Parameters parameters(private_handle);
  parameters.frame("frame_id", out.frame_id);
  parameters.frame("lidar_frame", out.lidar_frame);
  parameters.seed("seed", out.seed);
  describe(parameters, out);
  scan::check(out.beams, private_handle.getNamespace() + "/", parameters.faults());
  parameters.finish();
  return out;
}

}  // namespace vegetation_sim
