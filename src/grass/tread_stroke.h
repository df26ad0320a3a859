// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "vegetation_sim/common/math.h"
#include "vegetation_sim/grass/tread_map.h"

namespace vegetation_sim::grass {

inline Nanoseconds recoveredAt(Nanoseconds stamp, double recovery) {
  return recovery >= PERMANENT_RECOVERY ? std::numeric_limits<Nanoseconds>::max()
                                        : stamp + fromSeconds(recovery);
}

inline int floorOf(double x) {
  return static_cast<int>(std::floor(std::min(1e9, std::max(-1e9, x))));
}

/// The fine grid: places of its nodes, and the nodes next to a place.
struct TreadGrid {
  double origin_x, origin_y, spacing;
  double x(int column) const { return origin_x + column * spacing; }
  double y(int row) const { return origin_y + row * spacing; }
  int columnBelow(double place) const { return floorOf((place - origin_x) / spacing); }
  int rowBelow(double place) const { return floorOf((place - origin_y) / spacing); }
};

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

/// Some nodes of a row, from column first to last, and what a stroke asks of them.
struct TreadRow {
  int row, first, last;
  double y;
  std::array<float, TreadBlock::SIDE> tilt;  ///< below 0: not within reach
  std::array<double, TreadBlock::SIDE> side;
};

/// One segment being pressed: old doses in, new ones out, which may lie in the same window. In a
/// header so that the loop over the nodes is one piece of code.
struct TreadStroke {
  TreadStroke(const TreadLaw& l, const Point& from, const TreadSource& old, TreadSource& fresh)
      : law(l),
        field(from, fresh.position, l.reach, l.softness),
        low{std::min(from.x, fresh.position.x), std::min(from.y, fresh.position.y)},
        high{std::max(from.x, fresh.position.x), std::max(from.y, fresh.position.y)},
        full(CompactField::ofEndlessTrack(l.radius, l.reach, l.softness)),
        per_full(1.0 / full),
        enough(full / std::max(l.load, 1e-9)),
        square_reach(l.reach * l.reach),
        latest(recoveredAt(fresh.stamp, static_cast<float>(l.recovery))),
        before(old),
        after(fresh) {
    const bool moves = field.length() > 0.0, had_moved = old.has_moved;
    after.along = moves ? field.along() : old.along;
    after.has_moved = moves || had_moved;
  }

  // Leaves the nodes of a row that may be within reach.
  void cut(TreadRow& row, const TreadGrid& grid) const {
    constexpr double HAIR = 1e-9;  // whatever rounding does
    const double over = std::max(0.0, std::max(low.y - row.y, row.y - high.y));
    const double half = std::sqrt(std::max(0.0, square_reach - over * over)) + HAIR;
    row.first = std::max(row.first, grid.columnBelow(low.x - half));
    row.last = std::min(row.last, grid.columnBelow(high.x + half));
  }

  // New doses and the tilts that they ask for. @return number of nodes within reach.
  int measure(TreadRow& row, const TreadGrid& grid) const {
    const DoseRow<const double> old(before, row.row);
    const DoseRow<double> fresh(after, row.row);
    int touched = 0;
    for (int column = row.first; column <= row.last; ++column) {
      const auto i = static_cast<std::size_t>(column - row.first);
      const CompactField::Place place = field.placeOf({grid.x(column), row.y});
      row.tilt[i] = -1.f;
      if (place.square_distance >= square_reach) continue;
      ++touched;
      const double* known = old.at(column);
      double dose = known ? *known : 0.0;
      if (dose < enough) dose += field.fieldAt(place);  // no dose crushes more than fully
      // What the source leaves behind begins a new pass when it comes back.
      const bool stays = place.end * place.end + place.side * place.side < square_reach;
      if (double* kept = fresh.at(column)) *kept = stays ? dose : 0.0;
      row.tilt[i] = tiltOf(dose, place.square_distance);
      row.side[i] = place.side;
    }
    return touched;
  }

  // Of the dose within this pass, or of the print of the foot, which crushes even where it stands.
  float tiltOf(double dose, double square_distance) const {
    double part = dose * per_full;
    if (dose < enough && square_distance < 2.25 * law.radius * law.radius) {
      const double outside = std::sqrt(square_distance) - law.radius;
      part = std::max(part, 1.0 - smoothStep(outside / (0.5 * law.radius)));
    }
    return static_cast<float>(BEND_LIMIT * std::min(1.0, law.load * part));
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
  double full;      ///< dose that crushes fully
  double per_full;  ///< its inverse
  double enough;    ///< likewise, of this load
  double square_reach;
  Nanoseconds latest;  ///< when the last of the pressed nodes has recovered
  const TreadSource& before;
  TreadSource& after;
};

}  // namespace vegetation_sim::grass
