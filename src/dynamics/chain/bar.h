// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/dynamics/chain/chain.h"

namespace vegetation_sim::physics {

/// Returns whether the link is a round bar with its centre on its axis, which is the usual case.
inline bool isBar(const Link& link) {
  const Symmetric3& i = link.inertia;
  return link.centre.x() == 0.0 && link.centre.y() == 0.0 && i.xx == i.yy && i.xy == 0.0 &&
         i.xz == 0.0 && i.yz == 0.0;
}

}  // namespace vegetation_sim::physics
