// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "physics/chain_rows.h"
#include "vegetation_sim/physics/chain.h"

namespace vegetation_sim::physics {

// Between the plain types and lanes of rows; `rows` points to the lane in the first row.

/// What a root hangs on: F_ROWS numbers.
struct BaseRows {
  float value[F_ROWS] = {};
};
BaseRows baseRows(const BaseMotion& base);

/// Whether the link is a round bar with its centre on its axis.
bool isBar(const Link& link);
void fillLink(const Link& link, float* constants);
/// A lane without link: it never moves.
void fillNobody(float* constants);
void fillLoad(const Loads& loads, std::size_t link, float* rows);

/// What an anchor adds to the articulated inertia and bias of the joint in `slot`.
struct AnchorRows {
  int slot{0};
  float value[P_ROWS] = {};
};
/// `ahead` = theta h.
AnchorRows anchorRows(const Anchor& anchor, int slot, double ahead);

/// Adds a link to `out`; rows hold places relative to the base.
void readMotion(const float* motion, const BaseMotion& base, std::size_t link, Kinematics& out);
void resize(Kinematics& kinematics, std::size_t links);

/// guardedTheta of a tree whose fastest rate is `fastest` [rad/s].
double thetaFor(double fastest, double h, double theta);

}  // namespace vegetation_sim::physics
