// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "grass/tread/tread_recovery.h"
#include "grass/tread/tread_tilt.h"

namespace vegetation_sim::grass {

inline Nanoseconds recoveredAt(Nanoseconds stamp, double recovery) {
  return recovery >= PERMANENT_RECOVERY ? std::numeric_limits<Nanoseconds>::max()
                                        : stamp + fromSeconds(recovery);
}

inline int nodeBelow(double place, double origin, double per_spacing) {
  return floorOf((place - origin) * per_spacing);
}

/// One segment and its effect on a node. It is in a header so that the loop over the nodes is
/// inlined.
struct TreadStroke {
  /// @param full dose of an endless straight track at the law's radius.
  TreadStroke(const TreadLaw& l, double full, const Point& from, TreadSource& source)
      : law(l),
        line(CompactField(from, source.position, l.reach, l.softness), l, full),
        own(static_cast<float>(l.recovery)),
        latest(recoveredAt(source.stamp, own)),
        after(source) {
    if (!(line.field.length() > 0.0)) return;
    after.along = line.field.along();
    after.has_moved = true;
  }

  // The larger tilt counts (E15). Only a node that had recovered takes a new direction (S2-27).
  void press(float tilt, const TreadGrid& grid, std::uint64_t place, TreadBlock& block) {
    TreadNode& node = block.nodes[(place >> 28 & 0xF0) | (place & 0xF)];
    const auto now = static_cast<float>(double{node.tilt} * leftOf(node));
    if (now <= CRUNCHED) turn(grid, place, node);
    if (node.recovery != own) {
      if (tilt >= now) node.recovery = own;
      latest = std::max(latest, recoveredAt(after.stamp, double{node.recovery}));
    }
    node.tilt = std::max(now, tilt);
    node.stamp = after.stamp;
  }

  // Caches the result, since neighbours were mostly pressed together.
  double leftOf(const TreadNode& node) {
    if (node.stamp != seen.stamp || node.recovery != seen.recovery) {
      seen = node;
      left = tiltLeft(node, after.stamp);
    }
    return left;
  }

  // Sets the direction to sign(A.N) N + C, or outward below a foot that came straight down.
  void turn(const TreadGrid& grid, std::uint64_t place, TreadNode& node) const {
    const auto row = static_cast<int>(place >> 32), column = static_cast<int>(place & 0xFFFFFFFF);
    double x = grid.x(column) - after.position.x, y = grid.y(row) - after.position.y;
    if (after.has_moved) {
      const double side = y * after.along.x - x * after.along.y;
      const double sign = side > NO_SIDE ? 1.0 : side < -NO_SIDE ? -1.0 : 0.0;
      x = after.along.x - sign * after.along.y;
      y = after.along.y + sign * after.along.x;
    }
    const double size = std::sqrt(x * x + y * y);
    node.x = size > NO_SIDE ? static_cast<float>(x / size) : 1.f;
    node.y = size > NO_SIDE ? static_cast<float>(y / size) : 0.f;
  }

  const TreadLaw& law;
  TreadLine line;
  float own;           ///< recovery of the law [s]
  Nanoseconds latest;  ///< stamp at which the last pressed node has recovered
  TreadSource& after;
  TreadNode seen{};  ///< node of the cached result
  double left{0.0};  ///< cached share of the tilt
};

}  // namespace vegetation_sim::grass
