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

/// Nodes that may be within reach of a stroke, side by side.
struct alignas(64) TreadNodes {
  static constexpr int MOST = 64;  ///< a whole number of vectors
  double x[MOST], y[MOST];         ///< [m]
  double dose[MOST];               ///< before the stroke, then with it
  double kept[MOST];               ///< what of it stays within reach of the source
  double square[MOST];             ///< of the distance from the segment [m^2]
  double side[MOST];               ///< of the track, left positive [m]
  double tilt[MOST];               ///< that the stroke asks for [rad]
  int row[MOST], column[MOST];
  int slot[MOST];  ///< in the source's window; -1: beyond
  int count{0};

  void add(const TreadGrid& grid, int node_row, int node_column, double known, int in_window) {
    x[count] = grid.x(node_column);
    y[count] = grid.y(node_row);
    dose[count] = known;
    slot[count] = in_window;
    row[count] = node_row;
    column[count++] = node_column;
  }
};

/// Takes the stroke to the nodes: dose in, all else out. Runs on the widest vectors of the
/// processor; the same bits on each of them, and those of CompactField::fieldAt().
void measureNodes(const TreadLine& line, TreadNodes& nodes);

}  // namespace vegetation_sim::grass
