// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/grass/tread/cut_map.h"

namespace vegetation_sim::grass {

enum class CutterShape : int { BOX = 0, DISC = 1 };

/// Area that a mower deck or a cutter bar cuts.
struct Cutter {
  CutterShape shape{CutterShape::BOX};
  double width{0.5};    ///< across the heading, or diameter of the disc [m]
  double length{0.3};   ///< along the heading [m]; ignored for a disc
  double height{0.05};  ///< of the stubble [m]
  /// width of the swath, which lies behind the cutter [m]; 0: cut grass falls where it grew
  double swath_width{0.0};
};
void describe(FieldVisitor& visitor, Cutter& cutter);

/// Place and heading of a cutter on the map; `heading` is a unit vector.
struct CutterPose {
  Point position, heading{1.0, 0.0};
};

/// Returns the areas that a cutter sweeps on a straight way between two poses. A turn is split into
/// steps below 0.1 rad, so that an arc is missed by at most 0.13 % of the distance from the
/// centre. A turn of more than 90 degrees is a jump: only the last footprint is cut.
std::vector<CutArea> sweep(const Cutter& cutter, const CutterPose& from, const CutterPose& to);
/// Returns the footprint.
CutArea footprintOf(const Cutter& cutter, const CutterPose& pose);

}  // namespace vegetation_sim::grass
