// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Step of the joints, by the other two passes: back to the roots with Featherstone's articulated
// inertias, with spring, damper and theta scheme in the joint-space inertia, and out again with the
// accelerations. Included once per instruction set.

#if defined(VEGETATION_SIM_PHYSICS_CHAIN_STEP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGETATION_SIM_PHYSICS_CHAIN_STEP_INL_H_
#undef VEGETATION_SIM_PHYSICS_CHAIN_STEP_INL_H_
#else
#define VEGETATION_SIM_PHYSICS_CHAIN_STEP_INL_H_
#endif

#include "dynamics/batch_step/chain_body-inl.h"
#include "dynamics/integration/integrator.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::physics::HWY_NAMESPACE {

// Moves a body to the parent's joint, `d` before its own.
HWY_INLINE void shift(const Lanes3& d, Articulated& p) {
  const Lanes3 x = p.bx, y = p.by, z = p.bz;  // the old b
  p.bx = x + cross(d, {p.m.xx, p.m.xy, p.m.xz});
  p.by = y + cross(d, {p.m.xy, p.m.yy, p.m.yz});
  p.bz = z + cross(d, {p.m.xz, p.m.yz, p.m.zz});
  p.a.xx = p.a.xx + (d.y * (z.x + p.bz.x) - d.z * (y.x + p.by.x));
  p.a.yy = p.a.yy + (d.z * (x.y + p.bx.y) - d.x * (z.y + p.bz.y));
  p.a.zz = p.a.zz + (d.x * (y.z + p.by.z) - d.y * (x.z + p.bx.z));
  p.a.xy = p.a.xy + (d.y * z.y - d.x * p.bz.x + d.z * (p.bx.x - y.y));
  p.a.xz = p.a.xz + (d.x * p.by.x - d.z * y.z + d.y * (z.z - p.bx.x));
  p.a.yz = p.a.yz + (d.z * x.z - d.y * p.bx.y + d.x * (p.by.y - z.z));
  p.torque = p.torque + cross(d, p.force);
}

HWY_INLINE Lanes3 transposed(const Articulated& p, const Lanes3& v) {
  return {dot(p.bx, v), dot(p.by, v), dot(p.bz, v)};
}

/// Eliminates the joint from the inertia and bias of its body and all beyond, and moves the rest to
/// the parent's joint.
HWY_INLINE void inward(const Joints& at, Lanes step, bool drag, Articulated& p) {
  const Lanes3 first = load3(at.work, W_FIRST), second = load3(at.work, W_SECOND);
  const Lanes rx = load(at.state, S_RATE), ry = load(at.state, S_RATE + 1);
  const Lanes k = load(at.constants, C_STIFFNESS), nu = load(at.constants, C_DAMPING);
  const Lanes theta = load(at.state, S_THETA), ahead = theta * step, zero = hn::Zero(Tag());
  const Lanes ease = (all(1.f) - theta) * (all(1.f / 3.f) * step * step);
  const Lanes stiff =
      ahead * (ahead * k + nu) - hn::Min(ease * k, load(at.constants, C_GUARANTEED));
  addWrench(at, p);
  at.bars ? addBarInAir(at, ahead, p) : addBodyInAir(at, ahead, p);
  if (drag) addDrag(at, ahead, p);
  // `stiff` is a lower bound of both pivots, even after rounding.
  const Lanes3 a1 = p.a * first, b1 = transposed(p, first);
  Lanes3 a2 = p.a * second, b2 = transposed(p, second);
  const Lanes inverse1 = all(1.f) / (hn::Max(dot(first, a1), zero) + stiff);
  const Lanes across = dot(first, a2), l = across * inverse1;
  const Lanes inverse2 = all(1.f) / (hn::Max(dot(second, a2) - l * across, zero) + stiff);
  a2 = a2 - l * a1;
  b2 = b2 - l * b1;
  const Lanes x = load(at.state, S_Q) + ahead * rx, y = load(at.state, S_Q + 1) + ahead * ry;
  const Lanes u1 = loadOf(at, L_JOINT) - (k * x + nu * rx) - dot(first, p.torque);
  const Lanes u2 = loadOf(at, L_JOINT + 1) - (k * y + nu * ry) - dot(second, p.torque) - l * u1;
  const Lanes3 pa1 = inverse1 * a1, pa2 = inverse2 * a2, pb1 = inverse1 * b1, pb2 = inverse2 * b2;
  p.a = without(p.a, pa1, a1, pa2, a2);
  p.m = without(p.m, pb1, b1, pb2, b2);
  p.bx = p.bx - b1.x * pa1 - b2.x * pa2;
  p.by = p.by - b1.y * pa1 - b2.y * pa2;
  p.bz = p.bz - b1.z * pa1 - b2.z * pa2;
  p.torque = p.torque + u1 * pa1 + u2 * pa2;
  p.force = p.force + u1 * pb1 + u2 * pb2;
  shift(load3(at.work, W_ARM), p);
  store3(a1, at.work, W_GAIN);
  store3(b1, at.work, W_GAIN + 3);
  store3(a2, at.work, W_GAIN + 6);
  store3(b2, at.work, W_GAIN + 9);
  store3({inverse1, inverse2, l}, at.work, W_INVERSE);
  store(u1, at.work, W_DRIVE);
  store(u2, at.work, W_DRIVE + 1);
}

// ---- out again: accelerations, and the step ----------------------------------------------------

/// Accelerations of the spin and of the joint that joints cause.
struct Push {
  Lanes3 spin, linear;
};

template <class Put>
HWY_INLINE void eachRow(const Push& push, const Put& put) {
  eachRow(push.spin, 0, put);
  eachRow(push.linear, 3, put);
}

// Replaces values below this by zero [rad, rad/s]: otherwise a tree at rest would compute with
// denormal numbers, which are slow.
HWY_INLINE Lanes flushTiny(Lanes value) {
  return hn::IfThenElseZero(hn::Abs(value) > all(1e-18f), value);
}

// Does what ChainStepper::stopJoints does, on lanes.
HWY_INLINE void stop(Lanes step, Lanes* q, Lanes* rate) {
  const Tag d;
  const Lanes bend = all(static_cast<float>(LARGEST_BEND));
  const Lanes speed = all(static_cast<float>(LARGEST_TURN)) / step;
  const Lanes bend2 = q[0] * q[0] + q[1] * q[1];
  const auto far = bend2 > bend * bend;
  if (HWY_UNLIKELY(!hn::AllFalse(d, far))) {
    const Lanes outwards = hn::Max((q[0] * rate[0] + q[1] * rate[1]) / bend2, hn::Zero(d));
    const Lanes factor = bend / hn::Sqrt(bend2);
    for (int axis = 0; axis < 2; ++axis) {
      rate[axis] = hn::IfThenElse(far, rate[axis] - outwards * q[axis], rate[axis]);
      q[axis] = hn::IfThenElse(far, q[axis] * factor, q[axis]);
    }
  }
  const Lanes speed2 = rate[0] * rate[0] + rate[1] * rate[1];
  const auto fast = speed2 > speed * speed;
  if (HWY_LIKELY(hn::AllFalse(d, fast))) return;
  const Lanes factor = speed / hn::Sqrt(speed2);
  for (int axis = 0; axis < 2; ++axis)
    rate[axis] = hn::IfThenElse(fast, rate[axis] * factor, rate[axis]);
}

/// Accelerations of a joint, and what it passes to its children.
struct Solution {
  Lanes first, second;
  Push push;
};

HWY_INLINE Solution solve(const Joints& at, const Push& parent) {
  Solution out;
  out.push.linear = parent.linear + cross(parent.spin, load3(at.work, W_ARM));
  const auto drive = [&](int axis) HWY_ATTR {
    const int gain = W_GAIN + 6 * axis;
    return load(at.work, W_INVERSE + axis) *
           (load(at.work, W_DRIVE + axis) - dot(load3(at.work, gain), parent.spin) -
            dot(load3(at.work, gain + 3), out.push.linear));
  };
  out.second = drive(1);
  out.first = drive(0) - load(at.work, W_COUPLING) * out.second;
  out.push.spin =
      parent.spin + (out.first * load3(at.work, W_FIRST) + out.second * load3(at.work, W_SECOND));
  return out;
}

/// Steps q and rate; `fastest` grows to the largest rate. With `predicts`, stores half of the
/// change of the rates: until the middle of the next step they change by as much again, up to a
/// term of second order.
HWY_INLINE Push stepJoint(const Joints& at, const Push& parent, Lanes step, bool predicts,
                          Lanes& fastest) {
  const Solution solved = solve(at, parent);
  const Lanes ahead = load(at.state, S_THETA) * step;
  const Lanes acceleration[2] = {solved.first, solved.second};
  Lanes q[2] = {load(at.state, S_Q), load(at.state, S_Q + 1)};
  Lanes rate[2] = {load(at.state, S_RATE), load(at.state, S_RATE + 1)};
  for (int axis = 0; axis < 2; ++axis) {
    q[axis] = q[axis] + step * (rate[axis] + ahead * acceleration[axis]);
    rate[axis] = rate[axis] + step * acceleration[axis];
  }
  stop(step, q, rate);
  for (int axis = 0; axis < 2; ++axis) {
    rate[axis] = flushTiny(rate[axis]);
    const Lanes change = rate[axis] - load(at.state, S_RATE + axis);
    if (predicts) store(all(0.5f) * change, at.state, S_LEAD + axis);
    store(flushTiny(q[axis]), at.state, S_Q + axis);
    store(rate[axis], at.state, S_RATE + axis);
    fastest = hn::Max(fastest, hn::Abs(rate[axis]));
  }
  return solved.push;
}

}  // namespace vegetation_sim::physics::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle
