// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "dynamics/chain/symmetric.h"
#include "dynamics/integration/stability.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::physics {
namespace {

constexpr int ROUNDS = 20;
// covers what this many rounds may miss of the largest eigenvalue
constexpr double PADDING = 1.15;

/// A chain at rest in a pose, to which torques are applied.
class Probe {
 public:
  Probe(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
        const ChainState& state, const std::vector<Anchor>& anchors)
      : links_(links), anchors_(anchors), state_(state) {
    for (const BaseMotion& base : bases) {
      bases_.emplace_back();
      bases_.back().pose = base.pose;
    }
    state_.rate.assign(links.size(), Vec2::Zero());
    kinematicsOf(links_, bases_, state_, still_);
  }

  /// Returns the largest eigenvalue of M^-1 S, where S is the matrix of the springs or of the
  /// dampers.
  double largest(double Link::*joint, Symmetric3 Anchor::*anchor) {
    const Random random(1);
    std::vector<Vec2> x(links_.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = Vec2(random.uniform(2 * i, -1.0, 1.0), random.uniform(2 * i + 1, -1.0, 1.0));
    double rate = 0.0, norm = sizeOf(x);
    for (int i = 0; i < ROUNDS && norm > 0.0; ++i) {
      for (Vec2& v : x) v = (1.0 / norm) * v;
      apply(joint, anchor, x);
      norm = sizeOf(x);
      rate = std::max(rate, norm);
    }
    return PADDING * rate;
  }

 private:
  // In the norm of the kinetic energy's metric, growth per round never exceeds the eigenvalue. The
  // same holds in the norm of S, used here for what springs hold.
  double sizeOf(const std::vector<Vec2>& x) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
      sum += links_[i].stiffness * (x[i].x() * x[i].x() + x[i].y() * x[i].y());
    return std::sqrt(sum);
  }

  void apply(double Link::*joint, Symmetric3 Anchor::*anchor, std::vector<Vec2>& x) {
    loads_.clear(links_.size());
    // the second term cancels the spring of the pose
    for (std::size_t i = 0; i < links_.size(); ++i)
      loads_.joint_torque[i] = links_[i].*joint * x[i] + links_[i].stiffness * state_.q[i];
    if (!anchors_.empty()) {
      kinematicsOf(links_, bases_, {state_.q, x}, moved_);
      for (const Anchor& a : anchors_) {
        const auto i = static_cast<std::size_t>(a.link);
        const Vec3 force = multiply(a.*anchor, moved_.velocity[i] + cross(moved_.spin[i], a.arm));
        loads_.wrench[i].force += force;
        loads_.wrench[i].torque += cross(a.arm, force);
      }
    }
    body_.accelerations(links_, bases_, state_, still_, loads_, {}, x);
  }

  const std::vector<Link>& links_;
  const std::vector<Anchor>& anchors_;
  ChainState state_;
  std::vector<BaseMotion> bases_;
  Kinematics still_, moved_;
  Loads loads_;
  ArticulatedBody body_;
};

}  // namespace

ChainRates estimatedRates(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                          const ChainState& state, const std::vector<Anchor>& anchors) {
  Probe probe(links, bases, state, anchors);
  ChainRates out;
  out.spring = probe.largest(&Link::stiffness, &Anchor::stiffness);
  out.damper = probe.largest(&Link::damping, &Anchor::damping);
  return out;
}

ChainRates tighter(const ChainRates& guard, const ChainRates& estimate) {
  return {std::min(guard.spring, estimate.spring), std::min(guard.damper, estimate.damper),
          guard.beta};
}

}  // namespace vegetation_sim::physics
