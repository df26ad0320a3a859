// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "vegetation_sim/grass/tread/tread_map.h"

namespace vegetation_sim::grass {

inline int floorOf(double x) {
  const double near = std::min(1e9, std::max(-1e9, x));
  const int whole = static_cast<int>(near);
  return whole - (near < whole);
}

/// Positions of the nodes of the fine grid.
struct TreadGrid {
  double origin_x, origin_y, spacing, per_spacing;
  int last_column, last_row;
  double x(int column) const { return origin_x + column * spacing; }
  double y(int row) const { return origin_y + row * spacing; }
};

/// Range of columns of a row, both ends included; empty if last < first.
struct TreadSpan {
  int first, last;
};

/// Positions of the nodes of a row relative to a segment: CompactField::Place of column 0, and the
/// increments per column [m].
struct TreadRow {
  TreadRow(const CompactField::Parts& segment, const TreadGrid& grid, int row) {
    const Point along = segment.along;
    const double ax = segment.p0.x - grid.origin_x, ay = segment.p0.y - grid.y(row);
    start = ax * along.x + ay * along.y;
    side = ax * along.y - ay * along.x;
    start_step = -grid.spacing * along.x;
    side_step = -grid.spacing * along.y;
  }
  double start, side, start_step, side_step;
};

/// Constants of a segment and its law for vectorised code.
struct TreadLine {
  /// @param full dose of an endless straight track at the law's radius.
  TreadLine(const CompactField& segment, const TreadLaw& law, double full);

  /// Returns the columns of a row that may be within reach.
  TreadSpan spanOf(const TreadGrid& grid, int row) const;
  /// Returns the tilt of the stroke [rad], by the dose of this pass or by the print of a foot,
  /// which crushes even without motion.
  double tiltOf(double dose, double square_distance) const {
    double part = dose * per_full;
    if (dose < enough && square_distance < square_print)
      part = std::max(part, 1.0 - smoothStep((square_distance - square_radius) * per_print));
    return BEND_LIMIT * std::min(1.0, load * part);
  }

  CompactField field;
  Point low, high;  ///< bounding box of the segment
  double per_full;  ///< inverse of the dose of a full crush
  double enough;    ///< dose of a full crush at this load
  double load;
  /// squared radii where the print is full and ends, 1 / their difference
  double square_radius, square_print, per_print;
  double slant, widening;  ///< strip beside the segment: x per y, half the width of a row [m]
};

/// Rows of the grid with the doses of one source; a row has a whole number of vectors.
struct TreadBand {
  static constexpr int PITCH = 8;  ///< divisor of the row length [nodes]
  int first_column, first_row, rows, pitch;
  double* doses;  ///< [rows x pitch] [1/m^2]
  double* dosesOf(int row) const { return doses + std::ptrdiff_t{row - first_row} * pitch; }
};

/// Applies the stroke to the nodes of a band: adds to the doses, then keeps those within reach of
/// the segment's end. Uses the widest vectors of the processor, with the same bits on each of them
/// and without vectors.
void measureBand(const TreadLine& line, const TreadGrid& grid, const TreadBand& band,
                 TreadPresses& out);

}  // namespace vegetation_sim::grass
