// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/batch_step/batch_chain.h"
#include "dynamics/batch_step/chain_rows.h"

namespace vegetation_sim::physics {

// Converts between the plain types and lanes of rows; `rows` points to the lane in the first row.

/// The base of a root: F_ROWS numbers.
struct BaseRows {
  float value[F_ROWS] = {};
};
BaseRows baseRows(const BaseMotion& base);

/// `rows`: C_ROWS, or C_BAR_ROWS for a bar.
void fillLink(const Link& link, int rows, float* constants);
/// Fills a lane without link, which never moves.
void fillEmptyLane(int rows, float* constants);
inline void fillLoad(const Loads& loads, std::size_t link, float* rows) {
  const bool wrench = link < loads.wrench.size(), joint = link < loads.joint_torque.size();
  for (int i = 0; i < 3; ++i) {
    rows[(L_FORCE + i) * ROW] = wrench ? static_cast<float>(loads.wrench[link].force[i]) : 0.f;
    rows[(L_TORQUE + i) * ROW] = wrench ? static_cast<float>(loads.wrench[link].torque[i]) : 0.f;
  }
  const Drag drag = link < loads.drag.size() ? loads.drag[link] : Drag();
  for (int i = 0; i < 3; ++i) {
    rows[(L_ARM + i) * ROW] = static_cast<float>(drag.arm[i]);
    rows[(L_ALONG + i) * ROW] = static_cast<float>(drag.along[i]);
  }
  rows[L_ALL * ROW] = static_cast<float>(drag.all);
  for (int i = 0; i < 2; ++i)
    rows[(L_JOINT + i) * ROW] = joint ? static_cast<float>(loads.joint_torque[link][i]) : 0.f;
}

/// `beside` is null where the grip is on the axis.
void fillGrip(const Grip& grip, float* rows, float* beside);

/// Contribution of an anchor to the articulated inertia and bias of the joint in `slot`.
struct AnchorRows {
  int slot{0};
  float value[P_ROWS] = {};
};
/// `ahead` = theta h.
AnchorRows anchorRows(const Anchor& anchor, int slot, double ahead);

inline void readMotion(const float* motion, const Vec3& base, std::size_t link, Kinematics& out) {
  const auto read = [motion](int row) {
    return Vec3(motion[row * ROW], motion[(row + 1) * ROW], motion[(row + 2) * ROW]);
  };
  out.pose[link] = {base + read(M_POSITION),
                    {motion[M_TURN * ROW], motion[(M_TURN + 1) * ROW], motion[(M_TURN + 2) * ROW],
                     motion[(M_TURN + 3) * ROW]}};
  out.spin[link] = read(M_SPIN);
  out.velocity[link] = read(M_VELOCITY);
}
void resize(Kinematics& kinematics, std::size_t links);

/// Returns guardedTheta of a tree whose fastest rate is `fastest` [rad/s].
double thetaFor(double fastest, double h, double theta);
/// Returns productsOf of such a tree.
double productsFor(double fastest, double h);

}  // namespace vegetation_sim::physics
