// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/model/sensor_path.h"

#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scan {

SensorPath::SensorPath(const Pose& begin, const Pose& end, double seconds)
    : begin_(begin), way_(end.position - begin.position), seconds_(seconds) {
  Quat turn = conjugate(begin.orientation) * end.orientation;
  if (turn.w < 0.0) turn = {-turn.w, -turn.x, -turn.y, -turn.z};
  const Vec3 sine(turn.x, turn.y, turn.z);  // times the axis
  const double size = length(sine);
  if (!(size > 0.0)) return;
  axis_ = sine / size;
  angle_ = 2.0 * arcTangent(size, turn.w);
}

Pose SensorPath::at(double time) const {
  if (!moves()) return begin_;
  const double share = time / seconds_;
  const SinCos half = sinCos(0.5 * share * angle_);
  const Quat turn{half.cos, half.sin * axis_.x(), half.sin * axis_.y(), half.sin * axis_.z()};
  Pose out;
  out.position = begin_.position + share * way_;
  out.orientation = begin_.orientation * turn;
  return out;
}

Vec3 SensorPath::toBegin(double time, const Vec3& place) const {
  const Pose pose = at(time);
  const Vec3 world = pose.position + rotate(pose.orientation, place);
  return rotate(conjugate(begin_.orientation), Vec3(world - begin_.position));
}

}  // namespace vegetation_sim::scan
