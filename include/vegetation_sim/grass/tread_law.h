// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/common/fields.h"

namespace vegetation_sim::grass {

/// A place or direction on the map [m].
struct Point {
  double x{0.0}, y{0.0};
};

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

/// The convolution field of the segment p0-p1 at p, kernel (r^2 + eps^2)^(-3/2) [1/m^2]: paper 2,
/// section 4.2, in the signed form that is right and does not cancel (E5). 0 for a segment of no
/// length, infinite on the segment if eps = 0.
double treadField(const Point& p, const Point& p0, const Point& p1, double eps);

/// The same as printed, sines taken as the formula reads: cancels near the line's extension.
double treadFieldPrinted(const Point& p, const Point& p0, const Point& p1);

/// The crushing vector E(P) = F (sign(A.N) N + C) of paper 2; pure C on the track itself.
Point treadVector(const Point& p, const Point& p0, const Point& p1, double field);

/// Field of many points under one segment, with a kernel that ends at `reach`: exactly additive
/// over parts of a track, so it does not depend on the rate of the frames.
class CompactField {
 public:
  CompactField(const Point& p0, const Point& p1, double reach, double softness);

  /// Field and distance from the segment of a point; both from the same products.
  struct Sample {
    double field;            ///< [1/m^2]; 0 from `reach` on
    double square_distance;  ///< from the segment [m^2]
    double side;             ///< of the track, left positive [m]
  };
  Sample at(const Point& p) const;
  double length() const { return length_; }
  Point along() const { return along_; }

  /// Field of an endless straight track at `distance`.
  static double ofEndlessTrack(double distance, double reach, double softness);

 private:
  Point p0_, along_{1.0, 0.0};
  double length_{0.0}, square_reach_, square_softness_, edge_;
};

/// Shorter steps are no motion [m]; a point this near to the track has no side.
constexpr double SHORTEST_STROKE = 1e-6, NO_SIDE = 1e-9;

}  // namespace vegetation_sim::grass
