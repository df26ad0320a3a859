// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/cutters/cut_request.h"

#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"

namespace vegetation_sim {

grass::CutArea areaOf(const GrassCut& cut, const Pose& to_world) {
  grass::CutArea out = fromMsg(cut, "");
  for (auto* outline : {&out.outline, &out.swath})
    for (grass::Point& point : *outline) {
      const Vec3 p = transformed(to_world, Vec3(point.x, point.y, 0.0));
      point = {p.x(), p.y()};
    }
  Faults faults;
  check(out, "in the world frame: ", faults);
  faults.throwIfAny();
  return out;
}

}  // namespace vegetation_sim
