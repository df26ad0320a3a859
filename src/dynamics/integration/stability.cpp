// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/integration/stability.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "dynamics/chain/symmetric.h"

namespace vegetation_sim::physics {
namespace {

constexpr double INFINITE = std::numeric_limits<double>::infinity();
// Radius of a half disk about 0 on the left that the stability region of Runge-Kutta 4 contains.
constexpr double RUNGE_KUTTA_RADIUS = 2.6155;

// Returns whether |1 + z + z^2/2 + z^3/6 + z^4/24| <= 1, by Horner's rule.
bool rungeKuttaHolds(double re, double im) {
  double a = 1.0, b = 0.0;
  for (const double n : {4.0, 3.0, 2.0, 1.0}) {
    const double next = 1.0 + (a * re - b * im) / n;
    b = (a * im + b * re) / n;
    a = next;
  }
  return a * a + b * b <= 1.0 + 1e-12;
}

// Follows the ray of the faster root.
double rungeKuttaLimit(double w2, double c) {
  const double d = 0.25 * c * c - w2;
  const double re = -0.5 * c - std::sqrt(std::max(d, 0.0)), im = std::sqrt(std::max(-d, 0.0));
  double low = 0.0, high = 4.0 / std::sqrt(re * re + im * im);
  for (int i = 0; i < 60; ++i) {
    const double mid = 0.5 * (low + high);
    (rungeKuttaHolds(mid * re, mid * im) ? low : high) = mid;
  }
  return low;
}

double semiImplicitLimit(double w2, double c) {
  return w2 > 0.0 ? (std::sqrt(c * c + 4.0 * w2) - c) / w2 : c > 0.0 ? 2.0 / c : INFINITE;
}

/// Stiffness and inertia of one link's turn, own axes; see docs/physics.md.
struct Turn {
  Symmetric3 inertia;
  Symmetric3 spring, damper;
  double pull{0.0}, drag{0.0};  // anchors on the centre of mass, per mass
};

// Returns an upper bound of the largest eigenvalue of inertia^-1 w: row sums with both scaled to
// unit inertia.
double largestOf(const Symmetric3& inertia, const Symmetric3& w) {
  const Vec3 ix(inertia.xx, inertia.xy, inertia.xz), iy(inertia.xy, inertia.yy, inertia.yz),
      iz(inertia.xz, inertia.yz, inertia.zz);
  const Vec3 a = cross(iy, iz), b = cross(iz, ix), c = cross(ix, iy);
  const double scale = 1.0 / dot(ix, a);
  const Vec3 d(std::sqrt(inertia.xx), std::sqrt(inertia.yy), std::sqrt(inertia.zz));
  const std::array<Vec3, 3> rows{multiply(w, a), multiply(w, b), multiply(w, c)};
  double most = 0.0;
  for (int i = 0; i < 3; ++i) {
    double sum = 0.0;
    for (int j = 0; j < 3; ++j)
      sum += std::fabs(rows[static_cast<std::size_t>(i)][j]) * d[i] / d[j];
    most = std::max(most, scale * sum);
  }
  return most;
}

// Returns the inertia about the centre of mass, or about the joint for a link on a base, whose
// motion is known.
Symmetric3 inertiaOf(Dynamics dynamics, const Link& link) {
  if (dynamics != Dynamics::ARTICULATED) {
    const bool printed = dynamics == Dynamics::PAPER_PRINTED;
    return scaledIdentity(paperInertia(link, {printed, printed, printed}));
  }
  Symmetric3 out = link.inertia;
  if (link.parent >= 0) add(out, -1.0, aboutJoint(scaledIdentity(link.mass), link.centre));
  const double least = 1e-12 * std::max(out.xx, out.yy);
  out.zz = std::max(out.zz, least);
  return out;
}

// |a - b|^2 <= (1 + s) |a|^2 + (1 + 1/s) |b|^2 for any s > 0; the lighter link gets more.
double shareOf(const Turn& own, const Turn& parent, const Vec3& axis) {
  const double along = axis.z() * axis.z();
  const double heavy = 1.0 / (along / std::min(parent.inertia.xx, parent.inertia.yy) +
                              (1.0 - along) / parent.inertia.zz);
  return std::min(own.inertia.xx, own.inertia.yy) / heavy;
}

void addJoint(const Link& link, const Vec3& axis, double s, Turn& own, Turn& parent) {
  const Symmetric3 across{1.0, 1.0, 0.0, 0.0, 0.0, 0.0};
  Symmetric3 there = scaledIdentity(1.0);
  addSquare(there, -1.0, axis);
  add(own.spring, (1.0 + s) * link.stiffness, across);
  add(own.damper, (1.0 + s) * link.damping, across);
  add(parent.spring, (1.0 + 1.0 / s) * link.stiffness, there);
  add(parent.damper, (1.0 + 1.0 / s) * link.damping, there);
}

void addAnchor(Dynamics dynamics, const Anchor& anchor, const Link& link, const Quat& q,
               Turn& turn) {
  const bool turns_only = link.parent < 0 || dynamics != Dynamics::ARTICULATED;
  const Vec3 arm = turns_only ? anchor.arm : Vec3(anchor.arm - rotate(q, link.centre));
  const double k = anchor.stiffness.xx + anchor.stiffness.yy + anchor.stiffness.zz;
  const double nu = anchor.damping.xx + anchor.damping.yy + anchor.damping.zz;
  const double share = turns_only ? 1.0 : 2.0;
  add(turn.spring, share * k, scaledIdentity(dot(arm, arm)));
  add(turn.damper, share * nu, scaledIdentity(dot(arm, arm)));
  if (turns_only) return;
  turn.pull += share * k / link.mass;
  turn.drag += share * nu / link.mass;
}

double ratio(double damping, double stiffness) {
  return stiffness > 0.0 ? damping / stiffness : INFINITE;
}

}  // namespace

double jointLimit(Integrator integrator, double w2, double c) {
  switch (integrator) {
    case Integrator::EXPLICIT_EULER:
      return c * c < 4.0 * w2 ? c / w2 : 4.0 / (c + std::sqrt(c * c - 4.0 * w2));
    case Integrator::SEMI_IMPLICIT_EULER:
      return semiImplicitLimit(w2, c);
    case Integrator::RUNGE_KUTTA_4:
      return rungeKuttaLimit(w2, c);
    default:
      return INFINITE;
  }
}

ChainRates guardRates(Dynamics dynamics, const std::vector<Link>& links,
                      const Kinematics& kinematics, const std::vector<Anchor>& anchors) {
  std::vector<Turn> turns(links.size());
  ChainRates out;
  out.beta = INFINITE;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Link& link = links[i];
    turns[i].inertia = inertiaOf(dynamics, link);
    out.beta = std::min(out.beta, ratio(link.damping, link.stiffness));
    if (link.parent < 0) {
      turns[i].spring = {link.stiffness, link.stiffness, 0.0, 0.0, 0.0, 0.0};
      turns[i].damper = {link.damping, link.damping, 0.0, 0.0, 0.0, 0.0};
      continue;
    }
    const auto p = static_cast<std::size_t>(link.parent);
    const Vec3 axis =
        rotate(conjugate(kinematics.pose[p].orientation), axisZ(kinematics.pose[i].orientation));
    addJoint(link, axis, shareOf(turns[i], turns[p], axis), turns[i], turns[p]);
  }
  for (const Anchor& anchor : anchors) {
    const auto i = static_cast<std::size_t>(anchor.link);
    addAnchor(dynamics, anchor, links[i], kinematics.pose[i].orientation, turns[i]);
    out.beta = std::min(out.beta, ratio(anchor.damping.xx, anchor.stiffness.xx));
  }
  for (const Turn& turn : turns) {
    out.spring = std::max({out.spring, turn.pull, largestOf(turn.inertia, turn.spring)});
    out.damper = std::max({out.damper, turn.drag, largestOf(turn.inertia, turn.damper)});
  }
  return out;
}

double guardLimit(Integrator integrator, const ChainRates& rates) {
  switch (integrator) {
    case Integrator::EXPLICIT_EULER:  // complex roots: below c / w^2; real ones: below 2 / c
      return std::min(rates.beta, rates.damper > 0.0 ? 2.0 / rates.damper : INFINITE);
    case Integrator::SEMI_IMPLICIT_EULER:
      return semiImplicitLimit(rates.spring, rates.damper);
    case Integrator::RUNGE_KUTTA_4:
      return RUNGE_KUTTA_RADIUS / std::max(std::sqrt(rates.spring), rates.damper);
    default:
      return INFINITE;
  }
}

int subSteps(double limit, double h) {
  const double parts = h / (GUARD_MARGIN * limit);
  if (!(parts <= MOST_SUB_STEPS)) return 0;
  return std::max(1, static_cast<int>(std::ceil(parts)));
}

}  // namespace vegetation_sim::physics
