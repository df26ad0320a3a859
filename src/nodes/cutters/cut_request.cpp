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

void checkRoomToWait(const std::string& what, std::size_t waiting, std::size_t more,
                     std::size_t most) {
  if (waiting + more > most)
    throw InvalidInput(what + " = " + std::to_string(waiting + more) + " with the " +
                           std::to_string(more) + " of this request, allowed are 0 to " +
                           std::to_string(most),
                       FaultCode::NO_ROOM);
}

void checkSwept(const grass::CutArea& area) {
  Faults faults;
  check(area, "cutter: ", faults);
  faults.throwIfAny();
}

}  // namespace vegetation_sim
