// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/physics/chain.h"

namespace vegetation_sim::physics {

/// Rotation by a bend, a rotation vector without z.
Quat bendRotation(const Vec2& q);

/// Motion of a bend in the axes of the bent link.
struct BendMotion {
  Vec3 first, second;  ///< spin of the link per rate of each bend
  Vec3 bias;           ///< rate of change of the spin without acceleration [rad/s^2]
};
BendMotion bendMotion(const Vec2& q, const Vec2& rate);

}  // namespace vegetation_sim::physics
