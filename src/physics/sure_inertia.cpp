// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/physics/sure_inertia.h"

#include <algorithm>

#include "physics/symmetric.h"
#include "vegetation_sim/common/math.h"
#include "vegetation_sim/physics/articulated.h"

namespace vegetation_sim::physics {
namespace {

constexpr int PASSES = 4;       // more change nothing
constexpr double MARGIN = 0.8;  // for poses other than rest
constexpr double SHRINK = 0.7;  // until the proof at rest holds
constexpr int MOST_TRIALS = 12;

// A link's energy is at least that of turning about its centre of mass; on a base, its joint.
double turningInertia(const Link& link) {
  Symmetric3 out = link.inertia;
  if (link.parent >= 0) add(out, -1.0, aboutJoint(scaledIdentity(link.mass), link.centre));
  return std::max(0.0, std::min(out.xx, out.yy));
}

/// What a joint's energy costs its link and its parent, per inertia that it gets: |a - b|^2 <=
/// (1 + s) |a|^2 + (1 + 1/s) |b|^2, the lighter of both pays less.
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
  // Every joint takes what the scarcer of its two links can give; what is left goes round again.
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

// M - diag(sure_inertia) has no negative direction: elimination along the tree meets no pivot that
// is not positive.
bool holdsAtRest(const std::vector<Link>& links) {
  std::vector<Link> springs = links;
  for (Link& link : springs) link.stiffness = link.sure_inertia;
  const ChainState rest{std::vector<Vec2>(links.size(), Vec2::Zero()),
                        std::vector<Vec2>(links.size(), Vec2::Zero())};
  Kinematics kinematics;
  kinematicsOf(springs, {}, rest, kinematics);
  Loads none;
  none.clear(links.size());
  ArticulatedBody body;
  std::vector<Vec2> unused;
  body.accelerations(springs, {}, rest, kinematics, none, {-1.0, 0.0}, unused);
  return body.positive();
}

}  // namespace

void shareInertia(std::vector<Link>& links) {
  Sharing sharing(links);
  for (int i = 0; i < PASSES; ++i) sharing.grow();
  for (std::size_t i = 0; i < links.size(); ++i)
    links[i].sure_inertia = MARGIN * sharing.share()[i];
  for (int trial = 0; trial <= MOST_TRIALS && !holdsAtRest(links); ++trial)
    for (Link& link : links) link.sure_inertia *= trial < MOST_TRIALS ? SHRINK : 0.0;
}

}  // namespace vegetation_sim::physics
