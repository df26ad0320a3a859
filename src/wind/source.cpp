// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/wind/source.h"

namespace vegetation_sim::wind {

void check(const Source& source, Faults& faults) {
  check(source.primitive, faults);
  checkFrame(source, faults);
}

void checkFrame(const Source& source, Faults& faults) {
  const Primitive& p = source.primitive;
  if (source.attached_frame.empty()) {
    if (p.kind == Kind::WAKE && p.trajectory.size() < 2 && !(p.orbit_radius > 0.0))
      faults.add(
          "primitive " + inQuotes(p.name) +
          ": attached_frame, orbit_radius and a trajectory of two way points are missing, so "
          "the centre never moves and has no wake");
    return;
  }
  const std::string context = "primitive " + inQuotes(p.name) +
                              ": attached_frame = " + inQuotes(source.attached_frame) + " ";
  if (p.kind == Kind::BREEZE) faults.add(context + "is given, but a breeze is everywhere");
  if (!p.trajectory.empty())
    faults.add(context + "and a trajectory are both given; only one is allowed");
  if (source.attached_frame.front() == '/')
    faults.add(context + "begins with '/', which tf2 does not allow");
}

Source startedAt(Source source, Nanoseconds start) {
  Primitive& p = source.primitive;
  p.epoch += start;
  p.t_on += start;
  if (p.t_off != 0) p.t_off += start;
  for (Waypoint& point : p.trajectory) point.stamp += start;
  return source;
}

}  // namespace vegetation_sim::wind
