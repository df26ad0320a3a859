// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Velocity products as the mean of their values before and after the step: the first accelerations
// give the rates after it, the links' bias wrenches change by half of the difference, and the chain
// responds with unchanged inertias (ArticulatedBody::averageProducts on lanes). Included once per
// instruction set.

#if defined(VEGETATION_SIM_PHYSICS_CHAIN_MEAN_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGETATION_SIM_PHYSICS_CHAIN_MEAN_INL_H_
#undef VEGETATION_SIM_PHYSICS_CHAIN_MEAN_INL_H_
#else
#define VEGETATION_SIM_PHYSICS_CHAIN_MEAN_INL_H_
#endif

#include "dynamics/batch_step/chain_step-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::physics::HWY_NAMESPACE {

/// Data that a parent passes on: the push of its joints, its spin after the step, and the
/// accelerations of spin and joint at that spin if no joint accelerated.
struct NextMotion {
  Push push;
  Lanes3 spin, spin_rate, acceleration;
};

enum : int {
  H_PUSH,
  H_SPIN = H_PUSH + 6,
  H_SPIN_RATE = H_SPIN + 3,
  H_ACCELERATION = H_SPIN_RATE + 3
};
static_assert(H_ACCELERATION + 3 <= int{P_ROWS}, "it fits where articulated inertias pass");

HWY_INLINE NextMotion loadNextMotion(const float* rows, int stride) {
  return {{load3(rows, H_PUSH, stride), load3(rows, H_PUSH + 3, stride)},
          load3(rows, H_SPIN, stride),
          load3(rows, H_SPIN_RATE, stride),
          load3(rows, H_ACCELERATION, stride)};
}

// Returns those of a base from its F_ROWS.
HWY_INLINE NextMotion nextMotionOfBase(const float* rows, int stride) {
  const Lanes o = hn::Zero(Tag());
  return {{{o, o, o}, {o, o, o}},
          load3(rows, F_SPIN, stride),
          load3(rows, F_SPIN_RATE, stride),
          load3(rows, F_ACCELERATION, stride)};
}

template <class Put>
HWY_INLINE void eachRow(const NextMotion& ahead, const Put& put) {
  eachRow(ahead.push, put);
  eachRow(ahead.spin, H_SPIN, put);
  eachRow(ahead.spin_rate, H_SPIN_RATE, put);
  eachRow(ahead.acceleration, H_ACCELERATION, put);
}

// Returns a half where the guard is inactive, else 0.
HWY_INLINE Lanes weightOf(const Joints& at) {
  const auto sleeps =
      hn::And(load(at.state, S_THETA) == all(0.5f), load(at.state, S_PRODUCTS) == all(1.f));
  return hn::IfThenElseZero(sleeps, all(0.5f));
}

/// Stores the change of the bias wrench of the joint's link.
HWY_INLINE NextMotion predictBias(const Joints& at, const NextMotion& parent, Lanes step) {
  const Solution solved = solve(at, parent.push);
  const Lanes rx = load(at.state, S_RATE), ry = load(at.state, S_RATE + 1);
  const Lanes ahead = load(at.state, S_THETA) * step;
  const Lanes x = load(at.state, S_Q) + ahead * rx, y = load(at.state, S_Q + 1) + ahead * ry;
  const Axes axes = axesOf({load(at.kept, K_TURN), load(at.kept, K_TURN + 1),
                            load(at.kept, K_TURN + 2), load(at.kept, K_TURN + 3)});
  const Lanes3 change = bendBias(rotationSeries(x * x + y * y), axes, x, y,
                                 rx + step * solved.first, ry + step * solved.second);
  Frame frame;
  frame.axis = axes.z;
  frame.spin = load3(at.kept, K_SPIN) + step * solved.push.spin;
  frame.spin_rate = parent.spin_rate + (change + cross(parent.spin, frame.spin - parent.spin));
  const Lanes3 arm = load3(at.work, W_ARM);
  frame.acceleration = parent.acceleration +
                       (cross(parent.spin_rate, arm) + cross(parent.spin, cross(parent.spin, arm)));
  const Lanes one = all(1.f), weight = weightOf(at);
  const Bias bias = at.bars ? biasOfBar(at, frame, one) : biasOfBody(at, axes, frame, one);
  store3(weight * (bias.torque - load3(at.kept, K_BIAS)), at.kept, K_BIAS);
  store3(weight * (bias.force - load3(at.kept, K_BIAS + 3)), at.kept, K_BIAS + 3);
  return {solved.push, frame.spin, frame.spin_rate, frame.acceleration};
}

/// Adds the joint's part of the wrench on the link and all beyond; leaves the rest for the parent's
/// joint.
HWY_INLINE void inwardWrench(const Joints& at, Bias& sum) {
  sum.torque = sum.torque + load3(at.kept, K_BIAS);
  sum.force = sum.force + load3(at.kept, K_BIAS + 3);
  const Lanes zero = hn::Zero(Tag());
  const Lanes u1 = zero - dot(load3(at.work, W_FIRST), sum.torque);
  const Lanes u2 =
      zero - dot(load3(at.work, W_SECOND), sum.torque) - load(at.work, W_COUPLING) * u1;
  store(load(at.work, W_DRIVE) + u1, at.work, W_DRIVE);
  store(load(at.work, W_DRIVE + 1) + u2, at.work, W_DRIVE + 1);
  const Lanes x1 = load(at.work, W_INVERSE) * u1, x2 = load(at.work, W_INVERSE + 1) * u2;
  sum.force = sum.force + (x1 * load3(at.work, W_GAIN + 3) + x2 * load3(at.work, W_GAIN + 9));
  sum.torque = sum.torque + (x1 * load3(at.work, W_GAIN) + x2 * load3(at.work, W_GAIN + 6)) +
               cross(load3(at.work, W_ARM), sum.force);
}

}  // namespace vegetation_sim::physics::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle
