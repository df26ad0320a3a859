// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/dynamics/chain/chain.h"

namespace vegetation_sim::physics {

void Loads::clear(std::size_t links) {
  wrench.assign(links, Wrench());
  joint_torque.assign(links, Vec2::Zero());
  anchors.clear();
  drag.clear();
}

}  // namespace vegetation_sim::physics
