// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// First pass of the articulated-body algorithm over a vector of joints, out to the twigs: geometry,
// motion and rigid bodies, world axes, each about its own joint. The accelerations are split into
// those that velocities and bases cause if no joint accelerated, summed here, and the rest, so that
// no articulated inertia meets a bias. Included once per instruction set.

#if defined(VEGETATION_SIM_PHYSICS_CHAIN_OUT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGETATION_SIM_PHYSICS_CHAIN_OUT_INL_H_
#undef VEGETATION_SIM_PHYSICS_CHAIN_OUT_INL_H_
#else
#define VEGETATION_SIM_PHYSICS_CHAIN_OUT_INL_H_
#endif

#include "dynamics/batch_step/chain_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::physics::HWY_NAMESPACE {

/// The rows of the joints of one vector.
struct Joints {
  const float* constants;
  float* state;
  const float* loads;  ///< null: no loads
  float* work;
  const float* grips;   ///< null: no air
  const float* beside;  ///< read only where not all grips are `on_axis`
  const float* air;
  float* bias;   ///< of the link alone: six rows of `work`, or of `kept`
  float* kept;   ///< null: velocity products are not averaged
  bool bars;     ///< all joints are bars
  bool on_axis;  ///< air grips the axes of bars
};

HWY_INLINE Lanes loadOf(const Joints& at, int row) {
  return at.loads ? load(at.loads, row) : hn::Zero(Tag());
}

HWY_INLINE Lanes3 load3Of(const Joints& at, int row) {
  return {loadOf(at, row), loadOf(at, row + 1), loadOf(at, row + 2)};
}

/// Data that a parent passes on, see F_TURN and following, and its z axis. The z axis is computed
/// again by the receiver, because passing it on costs more.
struct Frame {
  LanesQuat turn;
  Lanes3 axis, spin, spin_rate, acceleration;
};

HWY_INLINE Frame loadFrame(const float* rows, int stride) {
  const LanesQuat turn{load(rows, F_TURN, stride), load(rows, F_TURN + 1, stride),
                       load(rows, F_TURN + 2, stride), load(rows, F_TURN + 3, stride)};
  return {turn, axesOf(turn).z, load3(rows, F_SPIN, stride), load3(rows, F_SPIN_RATE, stride),
          load3(rows, F_ACCELERATION, stride)};
}

/// Returns the second derivative of its z axis.
HWY_INLINE Lanes3 axisRate(const Frame& frame, Lanes products) {
  return cross(frame.spin_rate, frame.axis) +
         products * cross(frame.spin, cross(frame.spin, frame.axis));
}

// Calls put(row, value) for each row.
template <class Put>
HWY_INLINE void eachRow(const Lanes3& v, int row, const Put& put) {
  put(row, v.x);
  put(row + 1, v.y);
  put(row + 2, v.z);
}

template <class Put>
HWY_INLINE void eachRow(const Frame& frame, const Put& put) {
  put(F_TURN, frame.turn.w);
  eachRow({frame.turn.x, frame.turn.y, frame.turn.z}, F_TURN + 1, put);
  eachRow(frame.spin, F_SPIN, put);
  eachRow(frame.spin_rate, F_SPIN_RATE, put);
  eachRow(frame.acceleration, F_ACCELERATION, put);
}

/// Position and velocity of the joint and spin of the link before the step, for callers that need
/// the motion.
struct Trace {
  Lanes3 position, velocity, spin;
};

// `frame` is the link's. With PREDICTED its spin is predicted, and the parent passes on the other
// as well.
template <bool PREDICTED>
HWY_INLINE Trace traceOf(const Joints& at, const Frame& frame, const float* parent, int stride) {
  const Lanes3 arm = load3(at.work, W_ARM);
  const Lanes3 before = load3(parent, PREDICTED ? F_NOW : F_SPIN, stride);
  Trace out{load3(parent, F_POSITION, stride) + arm,
            load3(parent, F_VELOCITY, stride) + cross(before, arm), frame.spin};
  if constexpr (PREDICTED)
    out.spin = before + (load(at.state, S_RATE) * load3(at.work, W_FIRST) +
                         load(at.state, S_RATE + 1) * load3(at.work, W_SECOND));
  return out;
}

template <class Put>
HWY_INLINE void eachRow(const Trace& trace, const Put& put) {
  eachRow(trace.position, F_POSITION, put);
  eachRow(trace.velocity, F_VELOCITY, put);
}

HWY_INLINE void storeMotion(const Frame& frame, const Trace& trace, float* rows) {
  store(frame.turn.w, rows, M_TURN);
  store3({frame.turn.x, frame.turn.y, frame.turn.z}, rows, M_TURN + 1);
  store3(trace.spin, rows, M_SPIN);
  store3(trace.position, rows, M_POSITION);
  store3(trace.velocity, rows, M_VELOCITY);
}

/// Writes rows that are `stride` floats apart.
struct StoreRows {
  float* rows;
  int stride;
  HWY_INLINE void operator()(int row, Lanes value) const { store(value, rows, row, stride); }
};

/// Wrench that moves a link as its frame says, if no joint accelerates.
struct Bias {
  Lanes3 torque, force;
};

HWY_INLINE Bias biasOfBar(const Joints& at, const Frame& frame, Lanes products) {
  const Lanes3& z = frame.axis;
  const Lanes across = load(at.constants, C_XX);
  const Lanes excess = load(at.constants, C_ZZ) - across;
  const Lanes moment = load(at.constants, C_MOMENT), mass = load(at.constants, C_MASS);
  const Lanes3 turning = dot(z, frame.spin_rate) * (excess * z) +
                         (products * excess * dot(z, frame.spin)) * cross(frame.spin, z);
  return {(across * frame.spin_rate + turning) + cross(moment * z, frame.acceleration),
          mass * frame.acceleration + moment * axisRate(frame, products)};
}

HWY_INLINE Symmetric inertiaOf(const Joints& at) {
  return {load(at.constants, C_XX), load(at.constants, C_XY), load(at.constants, C_XZ),
          load(at.constants, C_YY), load(at.constants, C_YZ), load(at.constants, C_ZZ)};
}

HWY_INLINE Lanes3 momentOf(const Joints& at) {
  return {load(at.constants, C_BESIDE), load(at.constants, C_BESIDE + 1),
          load(at.constants, C_MOMENT)};
}

HWY_INLINE Bias biasOfBody(const Joints& at, const Axes& axes, const Frame& frame, Lanes products) {
  const Symmetric inertia = turnedInertia(axes, inertiaOf(at));
  const Lanes3 arm = turned(axes, momentOf(at));
  const Lanes3 torque =
      inertia * frame.spin_rate + products * cross(frame.spin, inertia * frame.spin);
  const Lanes3 force =
      cross(frame.spin_rate, arm) + products * cross(frame.spin, cross(frame.spin, arm));
  return {torque + cross(arm, frame.acceleration),
          load(at.constants, C_MASS) * frame.acceleration + force};
}

HWY_INLINE void keepBody(const Joints& at, const Axes& axes) {
  store6(turnedInertia(axes, inertiaOf(at)), at.work, W_INERTIA);
  store3(turned(axes, momentOf(at)), at.work, W_MOMENT);
}

/// Returns the rate of the spin that the joint adds while its rates are constant.
HWY_INLINE Lanes3 bendBias(const RotationSeries& g, const Axes& axes, Lanes x, Lanes y, Lanes rx,
                           Lanes ry) {
  const Lanes k = x * ry - y * rx, swept = x * rx + y * ry, e = g.dc * swept;
  return (k * (e * y + g.c * ry)) * axes.x - (k * (e * x + g.c * rx)) * axes.y -
         (k * (g.db * swept)) * axes.z;
}

/// Right Jacobian of the rotation vector (x, y, 0): computes the joint's axes, returns the spin.
HWY_INLINE Lanes3 jointSpin(const Joints& at, const Axes& axes, const RotationSeries& g, Lanes x,
                            Lanes y, Lanes rx, Lanes ry) {
  const Lanes3 p = (g.c * y) * axes.x - (g.c * x) * axes.y - g.b * axes.z;
  const Lanes3 first = axes.x - y * p, second = axes.y + x * p;
  store3(first, at.work, W_FIRST);
  store3(second, at.work, W_SECOND);
  return rx * first + ry * second;
}

// Keeps the frame for predictBias.
HWY_INLINE void keep(const Frame& frame, float* rows) {
  store(frame.turn.w, rows, K_TURN);
  store3({frame.turn.x, frame.turn.y, frame.turn.z}, rows, K_TURN + 1);
  store3(frame.spin, rows, K_SPIN);
}

// Returns the rate for velocity products: before the step, or as predicted for its middle.
template <bool PREDICTED>
HWY_INLINE Lanes rateOf(const Joints& at, int axis) {
  const Lanes now = load(at.state, S_RATE + axis);
  if constexpr (!PREDICTED) return now;
  const auto sleeps = load(at.state, S_THETA) == all(0.5f);
  return now + hn::IfThenElseZero(sleeps, load(at.state, S_LEAD + axis));
}

/// Computes the geometry at q + theta h rate, the rigid bodies and their bias wrenches.
template <bool PREDICTED>
HWY_INLINE Frame outward(const Joints& at, const Frame& parent, Lanes step) {
  const Lanes ahead = load(at.state, S_THETA) * step;
  const Lanes x = load(at.state, S_Q) + ahead * load(at.state, S_RATE),
              y = load(at.state, S_Q + 1) + ahead * load(at.state, S_RATE + 1);
  const Lanes rx = rateOf<PREDICTED>(at, 0), ry = rateOf<PREDICTED>(at, 1);
  const RotationSeries g = rotationSeries(x * x + y * y);
  const Lanes qx = all(0.5f) * g.s * x, qy = all(0.5f) * g.s * y;
  const LanesQuat r{load(at.constants, C_REST), load(at.constants, C_REST + 1),
                    load(at.constants, C_REST + 2), load(at.constants, C_REST + 3)};
  const LanesQuat local{r.w * g.w - r.x * qx - r.y * qy, r.w * qx + r.x * g.w - r.z * qy,
                        r.w * qy + r.y * g.w + r.z * qx, r.z * g.w + r.x * qy - r.y * qx};
  const Lanes h = load(at.constants, C_H);
  Frame out;
  out.turn = parent.turn * local;
  const Axes axes = axesOf(out.turn);
  const Lanes3 own = jointSpin(at, axes, g, x, y, rx, ry);
  store3(h * parent.axis, at.work, W_ARM);
  out.axis = axes.z;
  out.spin = parent.spin + own;
  const Lanes products = load(at.state, S_PRODUCTS);
  const Lanes3 change = bendBias(g, axes, x, y, rx, ry);
  out.spin_rate = parent.spin_rate + products * (change + cross(parent.spin, own));
  out.acceleration = parent.acceleration + h * axisRate(parent, products);
  at.bars ? store3(axes.z, at.work, W_AXIS) : keepBody(at, axes);
  const Bias bias = at.bars ? biasOfBar(at, out, products) : biasOfBody(at, axes, out, products);
  store3(bias.torque, at.bias, 0);
  store3(bias.force, at.bias, 3);
  if (at.kept) keep(out, at.kept);
  return out;
}

// ---- air ---------------------------------------------------------------------------------------

// The path that a joint of a bar takes depends on no other joint.
HWY_INLINE auto gripsAxis(const Joints& at) {
  const Lanes o = hn::Zero(Tag());
  return hn::And(load(at.beside, 0) == o, load(at.beside, 1) == o);
}

/// Returns the vector from the joint to the point where air acts on the link.
HWY_INLINE Lanes3 gripArm(const Joints& at, const Frame& frame) {
  const Lanes along = load(at.grips, G_ALONG);
  if (at.on_axis) return along * frame.axis;
  return turned(axesOf(frame.turn), {load(at.beside, 0), load(at.beside, 1), along});
}

/// Stores the velocity of the link at the point where air acts on it.
HWY_INLINE void keepGrip(const Joints& at, const Frame& frame, const Trace& trace) {
  Lanes3 swept = load(at.grips, G_ALONG) * cross(trace.spin, frame.axis);
  if (!at.on_axis) {
    const Lanes3 arm = gripArm(at, frame), beside = cross(trace.spin, arm);
    store3(arm, at.work, W_GRIP);
    if (!at.bars) {
      swept = beside;
    } else {
      const auto on_axis = gripsAxis(at);
      swept = {hn::IfThenElse(on_axis, swept.x, beside.x),
               hn::IfThenElse(on_axis, swept.y, beside.y),
               hn::IfThenElse(on_axis, swept.z, beside.z)};
    }
  }
  store3(trace.velocity + swept, at.work, W_GRIPPED);
}

}  // namespace vegetation_sim::physics::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle
