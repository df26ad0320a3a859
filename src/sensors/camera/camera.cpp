// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/camera/camera.h"

namespace vegetation_sim::scan {

void describe(FieldVisitor& v, Camera& c) {
  v.number("range_min", c.range_min, "m", {0.0, 100.0});
  v.number("range_max", c.range_max, "m", {0.1, 500.0});
  v.integer("samples", c.samples, "", {1, 64});
  v.choice("shadows", c.shadows, {"none", "sun"});
  describe(v, c.light);
  describe(v, c.exposure);
}

void check(const Camera& camera, const std::string& context, Faults& faults) {
  if (!(camera.range_min < camera.range_max))
    faults.add(context + "range_max = " + std::to_string(camera.range_max) +
               " is not above range_min = " + std::to_string(camera.range_min));
  const std::int64_t rays = std::int64_t{camera.lens.width} * camera.lens.height * camera.samples;
  if (rays > MOST_IMAGE_RAYS)
    faults.add(context + "samples = " + std::to_string(camera.samples) + " makes " +
               std::to_string(rays) + " rays an image, allowed are " +
               std::to_string(MOST_IMAGE_RAYS));
  check(camera.lens, context, faults);
}

}  // namespace vegetation_sim::scan
