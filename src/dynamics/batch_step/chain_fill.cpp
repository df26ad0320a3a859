// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/batch_step/chain_fill.h"

#include <algorithm>

#include "dynamics/integration/integrator.h"

namespace vegetation_sim::physics {
namespace {

float narrow(double x) {
  return static_cast<float>(x);
}

Vec3 crossed(const Vec3& a, const Vec3& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
          a.x() * b.y() - a.y() * b.x()};
}

void put(const Vec3& v, float* to, int stride = 1) {
  for (int i = 0; i < 3; ++i) to[i * stride] = narrow(v[i]);
}

}  // namespace

BaseRows baseRows(const BaseMotion& base) {
  const Quat& q = base.pose.orientation;
  BaseRows out;
  float* v = out.value;
  v[F_TURN] = narrow(q.w);
  put({q.x, q.y, q.z}, v + F_TURN + 1);
  put(base.spin, v + F_SPIN);
  put(base.spin_rate, v + F_SPIN_RATE);
  put(base.acceleration, v + F_ACCELERATION);
  put(base.velocity, v + F_VELOCITY);
  put(base.spin, v + F_NOW);
  return out;
}

void fillLink(const Link& link, int rows, float* constants) {
  const auto set = [&](int row, double value) { constants[row * ROW] = narrow(value); };
  const Symmetric3& i = link.inertia;
  set(C_H, link.h);
  set(C_REST, link.rest.w);
  set(C_REST + 1, link.rest.x);
  set(C_REST + 2, link.rest.y);
  set(C_REST + 3, link.rest.z);
  set(C_MASS, link.mass);
  set(C_STIFFNESS, link.stiffness);
  set(C_DAMPING, link.damping);
  set(C_GUARANTEED, link.guaranteed_inertia);
  set(C_MOMENT, link.mass * link.centre.z());
  set(C_XX, i.xx);
  set(C_ZZ, i.zz);
  if (rows == C_BAR_ROWS) return;
  set(C_BESIDE, link.mass * link.centre.x());
  set(C_BESIDE + 1, link.mass * link.centre.y());
  set(C_YY, i.yy);
  set(C_XY, i.xy);
  set(C_XZ, i.xz);
  set(C_YZ, i.yz);
}

void fillEmptyLane(int rows, float* constants) {
  Link none;
  none.mass = 0.0;
  none.inertia = Symmetric3();
  fillLink(none, rows, constants);
}

void fillGrip(const Grip& grip, float* rows, float* beside) {
  rows[G_ALONG * ROW] = narrow(grip.centre.z());
  rows[G_STEADY * ROW] = narrow(grip.steady);
  rows[G_SQUARE * ROW] = narrow(grip.square);
  for (int axis = 0; beside && axis < B_ROWS; ++axis)
    beside[axis * ROW] = narrow(grip.centre[axis]);
}

// The force at the point is the anchor's minus (theta^2 h^2 K + theta h C) times what accelerations
// of the joints add to its own: a mass there, without bias.
AnchorRows anchorRows(const Anchor& anchor, int slot, double ahead) {
  const auto mass = [&](double k, double c) { return ahead * (ahead * k + c); };
  const Symmetric3 &k = anchor.stiffness, &c = anchor.damping;
  const double xx = mass(k.xx, c.xx), yy = mass(k.yy, c.yy), zz = mass(k.zz, c.zz),
               xy = mass(k.xy, c.xy), xz = mass(k.xz, c.xz), yz = mass(k.yz, c.yz);
  const Vec3 mx(xx, xy, xz), my(xy, yy, yz), mz(xz, yz, zz), arm = anchor.arm;
  const Vec3 bx = crossed(arm, mx), by = crossed(arm, my), bz = crossed(arm, mz);
  const Vec3 ax = crossed(arm, {bx.x(), by.x(), bz.x()}),
             ay = crossed(arm, {bx.y(), by.y(), bz.y()}),
             az = crossed(arm, {bx.z(), by.z(), bz.z()});
  AnchorRows out;
  out.slot = slot;
  float* v = out.value;
  put(ax, v + P_A);
  put({ay.y(), ay.z(), az.z()}, v + P_A + 3);
  put(bx, v + P_B);
  put(by, v + P_B + 3);
  put(bz, v + P_B + 6);
  put({xx, xy, xz}, v + P_M);
  put({yy, yz, zz}, v + P_M + 3);
  put(Vec3(-crossed(arm, anchor.force)), v + P_TORQUE);
  put(Vec3(-anchor.force), v + P_FORCE);
  return out;
}

void resize(Kinematics& kinematics, std::size_t links) {
  kinematics.pose.resize(links);
  kinematics.spin.resize(links);
  kinematics.velocity.resize(links);
}

double thetaFor(double fastest, double h, double theta) {
  return fastest * h > GUARD_TURN ? 1.0 : std::max(0.5, 0.9 * theta);
}

double productsFor(double fastest, double h) {
  return fastest * h > WILD_TURN ? 0.0 : 1.0;
}

}  // namespace vegetation_sim::physics
