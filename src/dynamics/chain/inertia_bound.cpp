// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/chain/inertia_bound.h"

#include <algorithm>

#include "dynamics/chain/articulated.h"
#include "dynamics/chain/articulated_body.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::physics {
namespace {

constexpr int PASSES = 4;       // further passes change nothing
constexpr double MARGIN = 0.8;  // for poses other than rest
constexpr double SHRINK = 0.7;  // factor until the proof at rest holds
constexpr int MOST_TRIALS = 12;

// A link's energy is at least that of turning about its centre of mass; for a link on a base, about
// its joint.
double turningInertia(const Link& link) {
  Symmetric3 out = link.inertia;
  if (link.parent >= 0) add(out, -1.0, aboutJoint(scaledIdentity(link.mass), link.centre));
  return std::max(0.0, std::min(out.xx, out.yy));
}

/// The energy that a joint takes from its link and its parent, per inertia that it gets: |a - b|^2
/// <= (1 + s) |a|^2 + (1 + 1/s) |b|^2. The lighter of the two pays less.
struct Price {
  double own{1.0}, parent{0.0};
};

Price priceOf(double own, double parent) {
  const double s = cubeRoot(own / parent);
  return {1.0 + s, 1.0 + 1.0 / s};
}

class Sharing {
 public:
  explicit Sharing(const std::vector<Link>& links) : links_(links) {
    for (const Link& link : links) {
      budget_.push_back(turningInertia(link));
      price_.push_back(link.parent < 0 ? Price()
                                       : priceOf(budget_.back(), budget_[parentOf(link)]));
      share_.push_back(budget_.back() > 0.0 ? link.stiffness : 0.0);
    }
  }
  // Every joint takes what the scarcer of its two links can give; the next pass distributes the
  // rest.
  void grow() {
    spent_.assign(links_.size(), 0.0);
    for (std::size_t i = 0; i < links_.size(); ++i) {
      spent_[i] += price_[i].own * share_[i];
      if (links_[i].parent >= 0) spent_[parentOf(links_[i])] += price_[i].parent * share_[i];
    }
    for (std::size_t i = 0; i < links_.size(); ++i) {
      if (share_[i] <= 0.0) continue;
      double factor = budget_[i] / spent_[i];
      if (links_[i].parent >= 0) {
        const std::size_t p = parentOf(links_[i]);
        factor = std::min(factor, budget_[p] / spent_[p]);
      }
      share_[i] *= factor;
    }
  }
  const std::vector<double>& share() const { return share_; }

 private:
  static std::size_t parentOf(const Link& link) { return static_cast<std::size_t>(link.parent); }

  const std::vector<Link>& links_;
  std::vector<double> budget_, share_, spent_;
  std::vector<Price> price_;
};

using Body = ArticulatedBody::Body;

// Eliminates a body's joint about its own x and y axes and leaves the rest for its parent.
void eliminateJoint(double pivot1, double pivot2, double coupling, Body& body) {
  const Vec3 a1(body.a.xx, body.a.xy, body.a.xz), b1 = body.bx;
  const Vec3 a2 = Vec3(body.a.xy, body.a.yy, body.a.yz) - coupling * a1;
  const Vec3 b2 = body.by - coupling * b1;
  const Vec3 pa1 = a1 / pivot1, pa2 = a2 / pivot2;
  subtractTwo(body.a, pa1, a1, pa2, a2);
  subtractTwo(body.m, Vec3(b1 / pivot1), b1, Vec3(b2 / pivot2), b2);
  body.bx -= pa1.x() * b1 + pa2.x() * b2;
  body.by -= pa1.y() * b1 + pa2.y() * b2;
  body.bz -= pa1.z() * b1 + pa2.z() * b2;
}

// Transforms a body from its own axes to those in which the axes are given.
void turn(const Axes& axes, Body& body) {
  body.a = turned(body.a, axes.x, axes.y, axes.z);
  body.m = turned(body.m, axes.x, axes.y, axes.z);
  const Vec3 x = inAxes(axes, body.bx), y = inAxes(axes, body.by), z = inAxes(axes, body.bz);
  body.bx = axes.x.x() * x + axes.y.x() * y + axes.z.x() * z;
  body.by = axes.x.y() * x + axes.y.y() * y + axes.z.y() * z;
  body.bz = axes.x.z() * x + axes.y.z() * y + axes.z.z() * z;
}

// Returns whether M - diag(guaranteed_inertia) has no negative direction: elimination along the
// tree at rest finds positive pivots only. Each body is in its own axes.
bool holdsAtRest(const std::vector<Link>& links) {
  const Axes own{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  std::vector<Body> bodies(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    rigidBody(links[i], own, bodies[i]);
    bodies[i].torque = bodies[i].force = Vec3::Zero();
  }
  for (std::size_t i = links.size(); i-- > 0;) {
    const Link& link = links[i];
    Body& body = bodies[i];
    const double pivot1 = body.a.xx - link.guaranteed_inertia, coupling = body.a.xy / pivot1;
    const double pivot2 = body.a.yy - link.guaranteed_inertia - coupling * body.a.xy;
    if (!(pivot1 > 0.0 && pivot2 > 0.0)) return false;
    if (link.parent < 0) continue;
    eliminateJoint(pivot1, pivot2, coupling, body);
    turn(axesOf(link.rest), body);
    addChild(body, Vec3(0.0, 0.0, link.h), bodies[static_cast<std::size_t>(link.parent)]);
  }
  return true;
}

}  // namespace

void shareInertia(std::vector<Link>& links) {
  Sharing sharing(links);
  for (int i = 0; i < PASSES; ++i) sharing.grow();
  for (std::size_t i = 0; i < links.size(); ++i)
    links[i].guaranteed_inertia = MARGIN * sharing.share()[i];
  for (int trial = 0; trial <= MOST_TRIALS && !holdsAtRest(links); ++trial)
    for (Link& link : links) link.guaranteed_inertia *= trial < MOST_TRIALS ? SHRINK : 0.0;
}

}  // namespace vegetation_sim::physics
