// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wind/laws.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::wind {
namespace {

double horizontal(const Vec3& v) {
  return std::sqrt(v.x() * v.x() + v.y() * v.y());
}

/// Profile of a vortex with a solid core: rises like the distance, peaks with 1 at the core radius,
/// falls like 1/d.
double coreProfile(double d, double core) {
  const double rho = d / core;
  return 2.0 * rho / (1.0 + rho * rho);
}

/// The same profile divided by the distance [1/m], finite and smooth in the middle.
double coreProfilePerMetre(double d, double core) {
  const double rho = d / core;
  return 2.0 / (core * (1.0 + rho * rho));
}

double gustProfile(const Term& term, double behind) {
  return smootherStep(behind / term.rise) *
         (1.0 - smootherStep((behind - term.rise - term.plateau) / term.decay));
}

Vec3 gust(const Term& term, const Vec3& offset) {
  const double ahead = offset.x() * term.direction.x() + offset.y() * term.direction.y();
  const double beside = offset.y() * term.direction.x() - offset.x() * term.direction.y();
  return term.amplitude * (gustProfile(term, -ahead) * envelope(term, std::fabs(beside)));
}

Vec3 tornado(const Term& term, const Vec3& offset) {
  const double d = horizontal(offset);
  if (d >= term.radius) return Vec3::Zero();
  const double strength = term.speed * envelope(term, d);
  const double turn = strength * coreProfilePerMetre(d, term.core), rho = d / term.core;
  return {turn * (-offset.y() - term.inflow * offset.x()),
          turn * (offset.x() - term.inflow * offset.y()),
          term.updraft * strength / (1.0 + rho * rho)};
}

Vec3 blast(const Term& term, const Vec3& offset) {
  const double d = length(offset);
  if (d >= term.radius) return Vec3::Zero();
  return offset * (term.speed * envelope(term, d) * coreProfilePerMetre(d, term.core));
}

/// Returns one over the growth of a wake's width at a distance behind the centre of its body.
double wakeNarrowing(const Term& term, double behind) {
  return 1.0 / cubeRoot(1.0 + behind / (WAKE_SPREAD * term.radius));
}

/// Profile of a wake over the distance from its axis in widths: Gaussian, with a C2 end.
double wakeAcross(double widths) {
  if (widths >= WAKE_EDGE) return 0.0;
  return exponential(-widths * widths) * (1.0 - smootherStep(widths - (WAKE_EDGE - 1.0)));
}

// The far field of an axisymmetric turbulent wake (Tennekes and Lumley 1972, section 4.6): the
// momentum through each cross section is the same.
Vec3 wake(const Term& term, const Vec3& offset) {
  const double ahead = offset.x() * term.direction.x() + offset.y() * term.direction.y();
  const double behind = -ahead;
  if (behind <= -term.radius || behind >= term.plateau + term.decay) return Vec3::Zero();
  const double beside = offset.y() * term.direction.x() - offset.x() * term.direction.y();
  const double b = std::sqrt(beside * beside + offset.z() * offset.z());
  const double narrowing = wakeNarrowing(term, behind);
  const double along = smootherStep((behind + term.radius) / term.radius) *
                       (1.0 - smootherStep((behind - term.plateau) / term.decay));
  return term.amplitude *
         (along * (narrowing * narrowing) * wakeAcross(b * narrowing / term.radius));
}

/// Distances behind a centre and beside its axis.
struct WakeZone {
  double first, last, nearest;
};

// Returns what points within `reach` can have, as the centre moves and the direction turns within
// the second that a bound covers.
WakeZone zoneOf(const Term& term, const Vec3& offset, double reach) {
  const double ahead = offset.x() * term.direction.x() + offset.y() * term.direction.y();
  const double beside =
      std::fabs(offset.y() * term.direction.x() - offset.x() * term.direction.y());
  const double along = reach + term.travel, across = reach + term.sway;
  WakeZone zone{-ahead - along, -ahead + along, std::max(0.0, beside - across)};
  if (term.turn == 0.0) return zone;
  const double far = std::max(std::fabs(zone.first), std::fabs(zone.last));
  const double aside = beside + across, cosine = std::sqrt(1.0 - term.turn * term.turn);
  if (term.turn < 1.0) {
    zone.first = std::min(zone.first, zone.first * cosine) - aside * term.turn;
    zone.last = std::max(zone.last, zone.last * cosine) + aside * term.turn;
    zone.nearest = std::max(0.0, zone.nearest * cosine - far * term.turn);
  } else {
    zone.last = std::sqrt(far * far + aside * aside);
    zone.first = -zone.last;
    zone.nearest = 0.0;
  }
  return zone;
}

// Each factor is bounded by its largest value on the interval.
double wakeBound(const Term& term, const Vec3& offset, double reach) {
  const double end = term.plateau + term.decay;
  const WakeZone zone = zoneOf(term, offset, reach);
  if (zone.last <= -term.radius || zone.first >= end) return 0.0;
  const double first = std::max(zone.first, -term.radius), last = std::min(zone.last, end);
  const double along = smootherStep((last + term.radius) / term.radius) *
                       (1.0 - smootherStep((first - term.plateau) / term.decay));
  const double narrow = wakeNarrowing(term, first), wide = wakeNarrowing(term, last);
  // No turn brings a point nearer to the centre than it is.
  const double distance = std::max(0.0, horizontal(offset) - reach - term.travel - term.sway);
  const double square = distance * distance - std::max(first * first, last * last);
  const double nearest = std::max(zone.nearest, std::sqrt(std::max(0.0, square)));
  return std::min(term.limit, term.limit / WAKE_PEAK * along * (narrow * narrow)) *
         wakeAcross(nearest * wide / term.radius);
}

double gustBound(const Term& term, const Vec3& offset, double reach) {
  const double ahead = offset.x() * term.direction.x() + offset.y() * term.direction.y();
  const double beside = offset.y() * term.direction.x() - offset.x() * term.direction.y();
  // The profile has one maximum, so its largest value on an interval is nearest to that.
  const double margin = reach + term.travel;
  const double behind =
      std::clamp(std::max(term.rise, -ahead - margin), -ahead - margin, -ahead + margin);
  return term.peak * gustProfile(term, behind) *
         envelope(term, std::max(0.0, std::fabs(beside) - reach));
}

}  // namespace

Strip stripOf(const Term& term) {
  if (term.kind == Kind::GUST) return {0.0, term.rise + term.plateau + term.decay, term.radius};
  const double end = term.plateau + term.decay;
  return {term.radius, end, WAKE_EDGE * term.radius / wakeNarrowing(term, end)};
}

double envelope(const Term& term, double d) {
  const double u = (term.radius - d) / term.radius;
  return term.smooth ? smootherStep(u) : std::max(0.0, u);
}

Vec3 velocityOf(const Term& term, const Vec3& position) {
  const Vec3 offset = position - term.centre;
  switch (term.kind) {
    case Kind::GUST:
      return gust(term, offset);
    case Kind::TORNADO:
      return tornado(term, offset);
    case Kind::BLAST:
      return blast(term, offset);
    case Kind::WAKE:
      return wake(term, offset);
    default:
      return term.amplitude * envelope(term, horizontal(offset));  // S1-15
  }
}

double boundOf(const Term& term, const Vec3& position, double reach) {
  const Vec3 offset = position - term.centre;
  if (term.kind == Kind::GUST) return gustBound(term, offset, reach);
  if (term.kind == Kind::WAKE) return wakeBound(term, offset, reach);
  const double d = std::max(0.0, horizontal(offset) - reach);
  const double bound = term.peak * envelope(term, d);
  if (term.kind == Kind::DISK || d <= term.core) return bound;
  return bound * coreProfile(d, term.core);
}

}  // namespace vegetation_sim::wind
