// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/grass/tread_map.h"

namespace vegetation_sim::grass {

/// The fine grid: places of its nodes.
struct TreadGrid {
  double origin_x, origin_y, spacing;
  double x(int column) const { return origin_x + column * spacing; }
  double y(int row) const { return origin_y + row * spacing; }
};

/// A segment and how it treads, in numbers that vectors take.
struct TreadLine {
  CompactField::Parts field;
  double per_full;  ///< inverse of the dose that crushes fully
  double enough;    ///< dose that crushes fully at this load
  double radius, load;
};

/// Some nodes of a row, from column first on, side by side.
struct alignas(64) TreadRow {
  static constexpr int MOST = TreadBlock::SIDE;  ///< each list is a whole number of vectors
  double dose[MOST];                             ///< before the stroke, then with it
  double kept[MOST];                             ///< what of it stays within reach of the source
  double square[MOST];                           ///< of the distance from the segment [m^2]
  double side[MOST];                             ///< of the track, left positive [m]
  double tilt[MOST];                             ///< that the stroke asks for [rad]
  int row, first, last;                          ///< the latter two: columns
};

/// Takes the stroke to the nodes of a row: dose in, all else out. Runs on the widest vectors of the
/// processor; the same bits on each of them, and those of CompactField::fieldAt().
void measureRow(const TreadLine& line, const TreadGrid& grid, TreadRow& row);

}  // namespace vegetation_sim::grass
