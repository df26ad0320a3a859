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

/// How a source treads, such as a foot, a wheel or a mower deck (S2-21).
struct TreadLaw {
  double radius{0.12};    ///< half width that a straight track crushes fully [m]
  double reach{0.35};     ///< largest distance of an effect, at least 1.5 times the radius [m]
  double softness{0.10};  ///< eps of E5, which keeps the kernel finite on the track [m]
  double load{1.0};       ///< 1 crushes fully within the radius; a smaller load presses less
  double recovery{60.0};  ///< time until the grass stands again [s], or PERMANENT_RECOVERY
};
constexpr Range TREAD_RADIUS{0.005, 5.0};  ///< radii that are allowed [m]
void describe(FieldVisitor& visitor, TreadLaw& law);
/// Adds all faults of the law; `context` names its owner.
void check(TreadLaw law, const std::string& context, Faults& faults);

constexpr double PERMANENT_RECOVERY = 1e9;

/// One end of an integral along a track: its coordinate along the track and its softened distance
/// [m].
struct KernelEnd {
  double s, r;
};

/// Returns the integral of (square + s^2)^(-3/2) over s from lo to hi. If both ends are on one
/// side, the difference of the two terms is expanded, so that nothing cancels (E5).
inline double kernelIntegral(const KernelEnd& lo, const KernelEnd& hi, double square) {
  if (lo.s < 0.0 && hi.s > 0.0) return (hi.s * lo.r - lo.s * hi.r) / (lo.r * hi.r * square);
  const double both = std::fabs(hi.s) * lo.r + std::fabs(lo.s) * hi.r;
  return both > 0.0 ? (hi.s - lo.s) * std::fabs(hi.s + lo.s) / (lo.r * hi.r * both)
                    : std::numeric_limits<double>::infinity();
}

/// Field of one segment with a kernel that ends at `reach`. It is exactly additive over parts of a
/// track, so it does not depend on the frame rate.
class CompactField {
 public:
  CompactField(const Point& p0, const Point& p1, double reach, double softness);

  /// Constants of the segment, for vectorised code.
  struct Parts {
    Point p0, along{1.0, 0.0};
    double length{0.0}, square_reach{0.0}, square_softness{0.0};
    double end{0.0}, edge{0.0};  ///< softened reach [m], kernel there [1/m^3]
  };
  const Parts& parts() const { return parts_; }

  /// Position of a point relative to the segment.
  struct Place {
    double start, end;       ///< ends of the segment, counted along it from the point [m]
    double side;             ///< signed distance from the track, positive to the left [m]
    double square_distance;  ///< squared distance from the segment [m^2]
  };
  Place placeOf(const Point& p) const {
    const double ax = parts_.p0.x - p.x, ay = parts_.p0.y - p.y;
    return placeOf(ax * parts_.along.x + ay * parts_.along.y,
                   ax * parts_.along.y - ay * parts_.along.x);
  }
  /// Returns the position for a known start and side.
  Place placeOf(double start, double side) const {
    const double end = start + parts_.length;
    const double beyond = std::max(0.0, std::max(start, -end));
    return {start, end, side, side * side + beyond * beyond};
  }
  /// Returns the field [1/m^2], which is 0 from `reach` on. An end beyond the reach is cut off
  /// there, where its softened distance is known.
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

  /// Returns the field of an endless straight track at `distance`.
  static double ofEndlessTrack(double distance, double reach, double softness);

 private:
  Parts parts_;
};

/// A shorter step is no motion; a point nearer to the track than NO_SIDE has no side [m].
constexpr double SHORTEST_STROKE = 1e-6, NO_SIDE = 1e-9;

}  // namespace vegetation_sim::grass
