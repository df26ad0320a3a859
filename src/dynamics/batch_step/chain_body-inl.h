// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Contribution of a link, and of what acts on it, to the articulated inertia of its joint. Included
// once per instruction set.

#if defined(VEGETATION_SIM_PHYSICS_CHAIN_BODY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGETATION_SIM_PHYSICS_CHAIN_BODY_INL_H_
#undef VEGETATION_SIM_PHYSICS_CHAIN_BODY_INL_H_
#else
#define VEGETATION_SIM_PHYSICS_CHAIN_BODY_INL_H_
#endif

#include "dynamics/batch_step/chain_out-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::physics::HWY_NAMESPACE {

/// torque = a spin' + b acceleration, force = b^T spin' + m acceleration, plus the bias wrench; b
/// by its columns.
struct Articulated {
  Symmetric a;
  Lanes3 bx, by, bz;
  Symmetric m;
  Lanes3 torque, force;
};

HWY_INLINE Articulated nothing() {
  const Lanes o = hn::Zero(Tag());
  const Lanes3 o3{o, o, o};
  const Symmetric o6{o, o, o, o, o, o};
  return {o6, o3, o3, o3, o6, o3, o3};
}

// Adds a mass whose moment about the joint is `v`.
HWY_INLINE void addMass(Lanes mass, const Lanes3& v, Articulated& sum) {
  sum.bx = {sum.bx.x, sum.bx.y + v.z, sum.bx.z - v.y};
  sum.by = {sum.by.x - v.z, sum.by.y, sum.by.z + v.x};
  sum.bz = {sum.bz.x + v.y, sum.bz.y - v.x, sum.bz.z};
  sum.m.xx = sum.m.xx + mass;
  sum.m.yy = sum.m.yy + mass;
  sum.m.zz = sum.m.zz + mass;
}

/// A round bar about its joint: its inertia is `across`, and greater by `excess` along the axis.
struct Bar {
  Lanes mass, moment, across, excess;
};

HWY_INLINE Bar barOf(const Joints& at) {
  const Lanes across = load(at.constants, C_XX);
  return {load(at.constants, C_MASS), load(at.constants, C_MOMENT), across,
          load(at.constants, C_ZZ) - across};
}

HWY_INLINE void addBar(const Bar& bar, const Lanes3& z, Articulated& sum) {
  const Lanes3 ez = bar.excess * z;
  sum.a = sum.a + Symmetric{bar.across + ez.x * z.x, ez.x * z.y, ez.x * z.z,
                            bar.across + ez.y * z.y, ez.y * z.z, bar.across + ez.z * z.z};
  addMass(bar.mass, bar.moment * z, sum);
}

// Adds what acts on the body to its bias. Sums begin at +0, so that none is ever -0.
HWY_INLINE void addWrench(const Joints& at, Articulated& sum) {
  sum.torque = sum.torque + (load3(at.bias, 0) - load3Of(at, L_TORQUE));
  sum.force = sum.force + (load3(at.bias, 3) - load3Of(at, L_FORCE));
}

// Adds the implicit part of a drag: a mass against linear acceleration, `factor` times along
// along^T; `turn` = arm x along.
HWY_INLINE void addPull(Lanes factor, const Lanes3& turn, const Lanes3& along, Articulated& sum) {
  const Lanes3 swing = factor * turn, pull = factor * along;
  sum.a = sum.a + Symmetric{swing.x * turn.x, swing.x * turn.y, swing.x * turn.z,
                            swing.y * turn.y, swing.y * turn.z, swing.z * turn.z};
  sum.bx = sum.bx + pull.x * turn;
  sum.by = sum.by + pull.y * turn;
  sum.bz = sum.bz + pull.z * turn;
  sum.m = sum.m + Symmetric{pull.x * along.x, pull.x * along.y, pull.x * along.z,
                            pull.y * along.y, pull.y * along.z, pull.z * along.z};
}

// Adds a mass that is the same in all directions, at a point `arm` from the joint.
HWY_INLINE void addPoint(Lanes mass, const Lanes3& arm, Articulated& sum) {
  const Lanes3 v = mass * arm;
  const Lanes size = dot(v, arm);
  sum.a = sum.a + Symmetric{size - v.x * arm.x, hn::Neg(v.x * arm.y), hn::Neg(v.x * arm.z),
                            size - v.y * arm.y, hn::Neg(v.y * arm.z), size - v.z * arm.z};
  addMass(mass, v, sum);
}

/// Drag of the air on its grip; force and derivative are those of PhysicalSubtree::addWind.
struct AirDrag {
  Lanes3 wind;         ///< velocity relative to the grip
  Lanes drag, factor;  ///< force over wind; factor of its part along the wind, for addPull
};

HWY_INLINE AirDrag airDragOn(const Joints& at, Lanes steady, Lanes square, Lanes ahead) {
  AirDrag out;
  out.wind = load3(at.air, 0) - load3(at.work, W_GRIPPED);
  const Lanes size = hn::Sqrt(dot(out.wind, out.wind));
  out.drag = steady + square * size;
  out.factor = hn::IfThenElseZero(size > hn::Zero(Tag()), ahead * square / size);
  return out;
}

HWY_INLINE void addAirDrag(const AirDrag& air, const Lanes3& turn, Articulated& sum) {
  sum.torque = sum.torque - air.drag * turn;
  sum.force = sum.force - air.drag * air.wind;
  addPull(air.factor, turn, air.wind, sum);
}

// On the axis of a bar, the isotropic part acts as a heavier bar.
HWY_INLINE void addAirOnAxis(const Joints& at, const Lanes3& z, Lanes steady, Lanes square,
                             Lanes ahead, Bar& bar, Articulated& sum) {
  const Lanes g = load(at.grips, G_ALONG);
  const AirDrag air = airDragOn(at, steady, square, ahead);
  const Lanes mass = ahead * air.drag, moment = g * mass, second = g * moment;
  bar = {bar.mass + mass, bar.moment + moment, bar.across + second, bar.excess - second};
  addAirDrag(air, g * cross(z, air.wind), sum);
}

HWY_INLINE void addAirBeside(const Joints& at, Lanes steady, Lanes square, Lanes ahead,
                             Articulated& sum) {
  const Lanes3 arm = load3(at.work, W_GRIP);
  const AirDrag air = airDragOn(at, steady, square, ahead);
  addPoint(ahead * air.drag, arm, sum);
  addAirDrag(air, cross(arm, air.wind), sum);
}

// Lanes that do not take this path have no drag there.
HWY_INLINE void addBarInAir(const Joints& at, Lanes ahead, Articulated& sum) {
  const Lanes3 z = load3(at.work, W_AXIS);
  Bar bar = barOf(at);
  if (at.grips) {
    const Lanes steady = load(at.grips, G_STEADY), square = load(at.grips, G_SQUARE);
    if (at.on_axis) {
      addAirOnAxis(at, z, steady, square, ahead, bar, sum);
    } else {
      const auto on_axis = gripsAxis(at);
      addAirOnAxis(at, z, hn::IfThenElseZero(on_axis, steady), hn::IfThenElseZero(on_axis, square),
                   ahead, bar, sum);
      addAirBeside(at, hn::IfThenZeroElse(on_axis, steady), hn::IfThenZeroElse(on_axis, square),
                   ahead, sum);
    }
  }
  addBar(bar, z, sum);
}

HWY_INLINE void addBodyInAir(const Joints& at, Lanes ahead, Articulated& sum) {
  sum.a = sum.a + load6(at.work, W_INERTIA);
  addMass(load(at.constants, C_MASS), load3(at.work, W_MOMENT), sum);
  if (at.grips) addAirBeside(at, load(at.grips, G_STEADY), load(at.grips, G_SQUARE), ahead, sum);
}

// Adds the drag of the loads: see Drag.
HWY_INLINE void addDrag(const Joints& at, Lanes ahead, Articulated& sum) {
  const Lanes3 arm = load3(at.loads, L_ARM), along = load3(at.loads, L_ALONG);
  addPoint(ahead * load(at.loads, L_ALL), arm, sum);
  addPull(ahead, cross(arm, along), along, sum);
}

}  // namespace vegetation_sim::physics::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle
