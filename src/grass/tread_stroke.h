// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "grass/tread_lanes.h"

namespace vegetation_sim::grass {

inline Nanoseconds recoveredAt(Nanoseconds stamp, double recovery) {
  return recovery >= PERMANENT_RECOVERY ? std::numeric_limits<Nanoseconds>::max()
                                        : stamp + fromSeconds(recovery);
}

inline int floorOf(double x) {
  const double near = std::min(1e9, std::max(-1e9, x));
  const int whole = static_cast<int>(near);
  return whole - (near < whole);
}

inline int nodeBelow(double place, double origin, double per_spacing) {
  return floorOf((place - origin) * per_spacing);
}

/// Where the doses of one row are in a source's window.
class WindowRow {
 public:
  WindowRow(const TreadSource& source, int row) : first_(source.first_column) {
    const int r = row - source.first_row;
    if (r < 0 || r >= source.rows) return;
    columns_ = static_cast<unsigned>(source.columns);
    start_ = r * source.columns;
  }
  /// -1 beyond the window.
  int slotOf(int column) const {
    const auto c = static_cast<unsigned>(column - first_);
    return c < columns_ ? start_ + static_cast<int>(c) : -1;
  }

 private:
  int first_, start_{0};
  unsigned columns_{0};
};

/// One segment being pressed: old doses in, new ones out, which may lie in the same window. In a
/// header so that the loop over the nodes is one piece of code.
struct TreadStroke {
  /// @param full dose of an endless straight track at the law's radius.
  TreadStroke(const TreadLaw& l, double full, const Point& from, const TreadSource& old,
              TreadSource& fresh)
      : law(l),
        field(from, fresh.position, l.reach, l.softness),
        low{std::min(from.x, fresh.position.x), std::min(from.y, fresh.position.y)},
        high{std::max(from.x, fresh.position.x), std::max(from.y, fresh.position.y)},
        line{field.parts(), 1.0 / full, full / std::max(l.load, 1e-9), l.radius, l.load},
        latest(recoveredAt(fresh.stamp, static_cast<float>(l.recovery))),
        before(old),
        after(fresh) {
    const bool moves = field.length() > 0.0, had_moved = old.has_moved;
    after.along = moves ? field.along() : old.along;
    after.has_moved = moves || had_moved;
  }

  // Half of the row at y that may be within reach, beyond the segment's ends.
  double halfRow(double y) const {
    constexpr double HAIR = 1e-9;  // whatever rounding does
    const double over = std::max(0.0, std::max(low.y - y, y - high.y));
    return std::sqrt(std::max(0.0, line.field.square_reach - over * over)) + HAIR;
  }

  // Some nodes of a row, with what is known of their doses.
  void gather(const TreadGrid& grid, int row, int first, int last, TreadNodes& nodes) const {
    const WindowRow old(before, row), fresh(after, row);
    const double* doses = before.doses.data();
    for (int column = first; column <= last; ++column) {
      const int slot = old.slotOf(column);
      nodes.add(grid, row, column, slot < 0 ? 0.0 : doses[slot], fresh.slotOf(column));
    }
  }

  // What the source leaves behind begins a new pass when it comes back.
  void keepDoses(const TreadNodes& nodes) const {
    for (int i = 0; i < nodes.count; ++i)
      if (nodes.slot[i] >= 0) after.doses[static_cast<std::size_t>(nodes.slot[i])] = nodes.kept[i];
  }

  bool isTouched(const TreadNodes& nodes, int i) const {
    return nodes.square[i] < line.field.square_reach;
  }

  // True if the node was pressed so lately, and no more than now, that it is surely still down.
  bool isFresh(const TreadNode& node, float tilt) const {
    const Nanoseconds age = after.stamp - node.stamp;
    return node.tilt > 2.f * CRUNCHED && node.tilt <= tilt && age >= 0 &&
           static_cast<double>(age) * 1e-9 < 0.1 * double{node.recovery};
  }

  // Against what is there the larger tilt counts (E15); only a node that had risen takes a new
  // direction (S2-27).
  void press(float tilt, const Point& p, double side, TreadNode& node) {
    const float now = isFresh(node, tilt) ? tilt : tiltAt(node, after.stamp);
    if (now <= CRUNCHED) turn(p, side, node);
    const auto own = static_cast<float>(law.recovery);
    if (node.recovery != own) {
      if (tilt >= now) node.recovery = own;
      latest = std::max(latest, recoveredAt(after.stamp, double{node.recovery}));
    }
    node.tilt = std::max(now, tilt);
    node.stamp = after.stamp;
  }

  // sign(A.N) N + C, or outward under a foot that came straight down.
  void turn(const Point& p, double side, TreadNode& node) const {
    double x = p.x - after.position.x, y = p.y - after.position.y;
    if (after.has_moved) {
      const double sign = side > NO_SIDE ? 1.0 : side < -NO_SIDE ? -1.0 : 0.0;
      x = after.along.x - sign * after.along.y;
      y = after.along.y + sign * after.along.x;
    }
    const double size = std::sqrt(x * x + y * y);
    node.x = size > NO_SIDE ? static_cast<float>(x / size) : 1.f;
    node.y = size > NO_SIDE ? static_cast<float>(y / size) : 0.f;
  }

  const TreadLaw& law;
  CompactField field;
  Point low, high;  ///< box of the segment
  TreadLine line;
  Nanoseconds latest;  ///< when the last of the pressed nodes has recovered
  const TreadSource& before;
  TreadSource& after;
};

}  // namespace vegetation_sim::grass
