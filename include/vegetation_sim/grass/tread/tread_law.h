// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim::grass {

/// A place or direction on the map [m].
struct Point {
  double x{0.0}, y{0.0};
};

inline double distanceBetween(const Point& a, const Point& b) {
  return std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
}

/// How one source treads: a foot, a wheel, a mower deck (S2-21).
struct TreadLaw {
  double radius{0.12};    ///< half width that a straight track crushes fully [m]
  double reach{0.35};     ///< nothing beyond; at least 1.5 times the radius [m]
  double softness{0.10};  ///< of the kernel, keeps it finite on the track: eps of E5 [m]
  double load{1.0};       ///< 1 crushes fully within the radius, less presses less
  double recovery{60.0};  ///< the grass takes to rise again; PERMANENT_RECOVERY: never [s]
};
void describe(FieldVisitor& visitor, TreadLaw& law);
/// All faults of the law; `context` names its owner.
void check(TreadLaw law, const std::string& context, Faults& faults);

constexpr double PERMANENT_RECOVERY = 1e9;

/// An end of an integral along a track: how far along, and its softened distance [m].
struct KernelEnd {
  double s, r;
};

/// Integral of (square + s^2)^(-3/2) over s from lo to hi. With both ends on one side the
/// difference of the two terms is expanded, so that nothing cancels (E5).
inline double kernelIntegral(const KernelEnd& lo, const KernelEnd& hi, double square) {
  if (lo.s < 0.0 && hi.s > 0.0) return (hi.s * lo.r - lo.s * hi.r) / (lo.r * hi.r * square);
  const double both = std::fabs(hi.s) * lo.r + std::fabs(lo.s) * hi.r;
  return both > 0.0 ? (hi.s - lo.s) * std::fabs(hi.s + lo.s) / (lo.r * hi.r * both)
                    : std::numeric_limits<double>::infinity();
}

/// Field of many points under one segment, with a kernel that ends at `reach`: exactly additive
/// over parts of a track, so it does not depend on the rate of the frames.
class CompactField {
 public:
  CompactField(const Point& p0, const Point& p1, double reach, double softness);

  /// What it is made of, for those who evaluate it side by side.
  struct Parts {
    Point p0, along{1.0, 0.0};
    double length{0.0}, square_reach{0.0}, square_softness{0.0};
    double end{0.0}, edge{0.0};  ///< softened reach [m], kernel there [1/m^3]
  };
  const Parts& parts() const { return parts_; }

  /// Where a point is beside the segment.
  struct Place {
    double start, end;       ///< ends of the segment, counted along it from the point [m]
    double side;             ///< of the track, left positive [m]
    double square_distance;  ///< from the segment [m^2]
  };
  Place placeOf(const Point& p) const {
    const double ax = parts_.p0.x - p.x, ay = parts_.p0.y - p.y;
    return placeOf(ax * parts_.along.x + ay * parts_.along.y,
                   ax * parts_.along.y - ay * parts_.along.x);
  }
  /// From where the segment starts and on which side it is.
  Place placeOf(double start, double side) const {
    const double end = start + parts_.length;
    const double beyond = std::max(0.0, std::max(start, -end));
    return {start, end, side, side * side + beyond * beyond};
  }
  /// Field there [1/m^2]; 0 from `reach` on. An end that lies beyond is cut off at the reach, where
  /// its softened distance is known.
  double fieldAt(const Place& place) const {
    if (place.square_distance >= parts_.square_reach) return 0.0;
    const double beside = place.side * place.side, room = parts_.square_reach - beside;
    const double square = beside + parts_.square_softness;
    double lo = place.start, hi = place.end, r0 = parts_.end, r1 = parts_.end;
    const bool cut_lo = lo < 0.0 && lo * lo > room, cut_hi = hi > 0.0 && hi * hi > room;
    const double half = cut_lo || cut_hi ? std::sqrt(room) : 0.0;
    if (cut_lo)
      lo = -half;
    else
      r0 = std::sqrt(square + lo * lo);
    if (cut_hi)
      hi = half;
    else
      r1 = std::sqrt(square + hi * hi);
    if (!(hi > lo)) return 0.0;
    return kernelIntegral({lo, r0}, {hi, r1}, square) - (hi - lo) * parts_.edge;
  }
  double fieldAt(const Point& p) const { return fieldAt(placeOf(p)); }
  double length() const { return parts_.length; }
  Point along() const { return parts_.along; }

  /// Field of an endless straight track at `distance`.
  static double ofEndlessTrack(double distance, double reach, double softness);

 private:
  Parts parts_;
};

/// Shorter steps are no motion [m]; a point this near to the track has no side.
constexpr double SHORTEST_STROKE = 1e-6, NO_SIDE = 1e-9;

}  // namespace vegetation_sim::grass
