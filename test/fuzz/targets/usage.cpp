// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/targets/usage.h"

#include <cmath>

namespace vegetation_sim::fuzz {

void sweepOnce(const scan::Scene& scene) {
  scan::Lidar lidar;
  lidar.beams.rings = 2;
  lidar.beams.columns = 6;
  lidar.beams.range_max = SENSOR_RANGE;
  static ThreadPool threads(1);
  Pose sensor;
  sensor.position = SENSOR_PLACE;
  for (const scan::Return& beam : scan::sweep(scene, lidar, sensor, {1, 1, 1}, threads))
    if (std::isnan(beam.range) || (std::isfinite(beam.range) && beam.range < 0.0))
      throw BrokenPromise("a range is " + std::to_string(beam.range));
}

void requireFinite(const Vec3& value, const char* what) {
  if (!value.allFinite()) throw BrokenPromise(std::string(what) + " is not finite");
}

void requireFinite(const std::vector<Pose>& poses, const char* what) {
  for (const Pose& pose : poses) {
    requireFinite(pose.position, what);
    const Quat& q = pose.orientation;
    requireFinite(Vec3(q.x + q.w, q.y, q.z), what);
  }
}

void requireFinite(const std::vector<float>& values, const char* what) {
  for (const float value : values)
    if (!std::isfinite(value)) throw BrokenPromise(std::string(what) + " is not finite");
}

}  // namespace vegetation_sim::fuzz
