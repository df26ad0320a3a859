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
  return static_cast<int>(std::floor(std::min(1e9, std::max(-1e9, x))));
}

inline int nodeBelow(double place, double origin, double spacing) {
  return floorOf((place - origin) / spacing);
}

/// Doses of one row of a source's window.
template <class Dose>
class DoseRow {
 public:
  template <class Source>
  DoseRow(Source& source, int row) : first_(source.first_column) {
    const int r = row - source.first_row;
    if (r < 0 || r >= source.rows) return;
    columns_ = static_cast<unsigned>(source.columns);
    doses_ = source.doses.data() + static_cast<std::size_t>(r) * columns_;
  }
  /// Null beyond the window.
  Dose* at(int column) const {
    const auto c = static_cast<unsigned>(column - first_);
    return c < columns_ ? doses_ + c : nullptr;
  }

 private:
  int first_;
  unsigned columns_{0};
  Dose* doses_{nullptr};
};

/// One segment being pressed: old doses in, new ones out, which may lie in the same window. In a
/// header so that the loop over the nodes is one piece of code.
struct TreadStroke {
  TreadStroke(const TreadLaw& l, const Point& from, const TreadSource& old, TreadSource& fresh)
      : law(l),
        field(from, fresh.position, l.reach, l.softness),
        low{std::min(from.x, fresh.position.x), std::min(from.y, fresh.position.y)},
        high{std::max(from.x, fresh.position.x), std::max(from.y, fresh.position.y)},
        line(lineOf(l, field)),
        latest(recoveredAt(fresh.stamp, static_cast<float>(l.recovery))),
        before(old),
        after(fresh) {
    const bool moves = field.length() > 0.0, had_moved = old.has_moved;
    after.along = moves ? field.along() : old.along;
    after.has_moved = moves || had_moved;
  }

  static TreadLine lineOf(const TreadLaw& law, const CompactField& field) {
    const double full = CompactField::ofEndlessTrack(law.radius, law.reach, law.softness);
    return {field.parts(), 1.0 / full, full / std::max(law.load, 1e-9), law.radius, law.load};
  }

  // Leaves the nodes of a row that may be within reach.
  void cut(TreadRow& row, const TreadGrid& grid) const {
    constexpr double HAIR = 1e-9;  // whatever rounding does
    const double y = grid.y(row.row), over = std::max(0.0, std::max(low.y - y, y - high.y));
    const double room = line.field.square_reach - over * over;
    const double half = std::sqrt(std::max(0.0, room)) + HAIR;
    row.first = std::max(row.first, nodeBelow(low.x - half, grid.origin_x, grid.spacing));
    row.last = std::min(row.last, nodeBelow(high.x + half, grid.origin_x, grid.spacing));
  }

  // New doses and the tilts that they ask for. @return number of nodes within reach.
  int measure(TreadRow& row, const TreadGrid& grid) const {
    const DoseRow<const double> old(before, row.row);
    const DoseRow<double> fresh(after, row.row);
    const int count = row.last - row.first + 1;
    for (int i = 0; i < count; ++i) {
      const double* known = old.at(row.first + i);
      row.dose[i] = known ? *known : 0.0;
    }
    measureRow(line, grid, row);
    int touched = 0;
    for (int i = 0; i < count; ++i) {
      if (!isTouched(row, i)) continue;
      ++touched;
      // What the source leaves behind begins a new pass when it comes back.
      if (double* kept = fresh.at(row.first + i)) *kept = row.kept[i];
    }
    return touched;
  }

  bool isTouched(const TreadRow& row, int i) const {
    return row.square[i] < line.field.square_reach;
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
    if (tilt >= now)
      node.recovery = static_cast<float>(law.recovery);
    else
      latest = std::max(latest, recoveredAt(after.stamp, double{node.recovery}));
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
