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

bool switchCutters(const std_srvs::SetBool::Request& request, bool replay, CutterFollower& cutters,
                   std_srvs::SetBool::Response& response) {
  response.success = !replay;
  response.message = replay         ? "a replay follows its recorded events only"
                     : request.data ? "cutters are on"
                                    : "cutters are off";
  if (!replay) cutters.setEnabled(request.data != 0);
  return !replay;
}

void checkSwept(const grass::CutArea& area) {
  Faults faults;
  check(area, "cutter: ", faults);
  faults.throwIfAny();
}

}  // namespace vegetation_sim
